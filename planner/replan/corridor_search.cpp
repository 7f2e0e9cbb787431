#include "planner/replan/corridor_search.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "planner/base/rng.hpp"
#include "planner/replan/nearby_solids.hpp"
#include "planner/replan/sidestep.hpp"
#include "planner/replan/stretch_search.hpp"
#include "planner/replan/taut_string.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Size of the box in units of the natural one, by round.
constexpr std::array kBoxFactors{1.0, 1.0, 2.0, 1.0, 4.0, 1.5};
/// Of the swarm's iterations in the first rounds: short at first, so that many corridors are seen early.
constexpr std::array kFirstIterations{3, 6, 6, 12, 12};
/// A better path must be better by this share to be offered again.
constexpr double kGain = 1e-6;
constexpr std::uint64_t kPolishEvaluations = 400;
/// Looks of the first tree, and of those in random order.
constexpr std::uint64_t kFirstLooks = 4000;
constexpr std::uint64_t kLooks = 400;
constexpr int kTreesPerRound = 4;
constexpr std::size_t kTreesPerSwarm = 8;  ///< along stretches
constexpr int kRefinements = 3;
/// A path of many points is improved along stretches in one round of so many.
constexpr int kStretchesEvery = 4;
/// Evaluations kept back for what comes after a step: its last look, and the offer.
constexpr std::uint64_t kSpare = 6;
/// A chain whose length after the first rounds of the polish is beyond the best by this share is given up.
constexpr double kHopeless = 5e-4;

class Search {
 public:
  Search(const DetourProblem& problem, const CorridorParams& params, const StopCondition& stop,
         std::uint64_t seed, const AcceptCorridor& accept)
      : problem_(problem),
        params_(params),
        stop_(stop),
        accept_(accept),
        rng_(seed),
        nearby_(problem.field()),
        sidestep_(problem.field(), nearby_, problem.limits()),
        taut_(problem.field(), nearby_, problem.limits(), problem.distance_m()),
        stretches_(problem, params, sidestep_, taut_, rng_),
        steepest_(steepest_slope(problem.limits())) {}

  std::uint64_t evaluations() const { return evaluations_; }
  std::uint64_t left() const {
    return stop_.max_evaluations > evaluations_ ? stop_.max_evaluations - evaluations_ : 0;
  }
  bool ended() const { return stop_.reached(evaluations_, 0); }
  bool found() const { return accepted_ < kInfinity; }
  double accepted() const { return accepted_; }
  double least_violation_m() const { return least_violation_m_; }

  /// Takes the chain if it is better than the best, free, and accepted.
  bool offer(const std::vector<Vec3>& chain) {
    const std::vector<Vec3> flown = as_flown(chain, steepest_);
    const std::span<const Vec3> inner(flown.data() + 1, flown.size() - 2);
    const DetourProblem::Cost cost = problem_.cost(inner);
    ++evaluations_;
    least_violation_m_ = std::min(least_violation_m_, cost.violation_m);
    const double value = problem_.value(cost);
    if (cost.violation_m > 0.0 || value >= accepted_ * (1.0 - kGain)) return false;
    refused_ = !accept_(Corridor{{inner.begin(), inner.end()}, cost, value}, evaluations_);
    if (refused_) return false;
    accepted_ = value;
    best_ = chain;
    return true;
  }

  void try_tree(double noise, std::uint64_t looks) {
    const DetourEnds& ends = problem_.ends();
    const auto hops = static_cast<std::uint64_t>(problem_.waypoints()) + 1;
    if (left() <= kSpare) return;
    looks = std::min(looks, left() > looks ? looks : (left() - kSpare) * hops);
    sidestep_.find(ends.from_m, ends.to_m, ends.from_time_s, noise, rng_, looks, chain_);
    evaluations_ += 1 + sidestep_.looks() / hops;
    if (chain_.empty()) return;
    if (!found()) offer(chain_);
    polish(chain_);
  }

  void try_guess(const std::vector<Vec3>& waypoints) {
    chain_.assign(1, problem_.ends().from_m);
    chain_.insert(chain_.end(), waypoints.begin(), waypoints.end());
    chain_.push_back(problem_.ends().to_m);
    offer(chain_);
    polish(chain_);
  }

  /// Pulls the chain taut, with more points where they help, and offers what comes of it.
  void polish(std::vector<Vec3>& chain) {
    if (!params_.parts.polish || chain.size() < 3) return;
    const double longest_m = found() && problem_.objective() == DetourObjective::kLength
                                 ? accepted_ * problem_.distance_m() * (1.0 + kHopeless)
                                 : kInfinity;
    taut_.set_reserve(1.0);
    taut_.set_ground_factor(1.0);
    double factor = 1.0;
    double before_m = kInfinity;
    for (int k = 0; k <= kRefinements && !ended() && left() > kSpare; ++k) {
      const TautResult taut = taut_.tighten(chain, problem_.ends().from_time_s,
                                            std::min(left() - kSpare, kPolishEvaluations), longest_m);
      evaluations_ += taut.evaluations;
      if (taut.given_up) return;
      refused_ = false;
      const bool better = offer(chain);
      if (!better && refused_ && factor < 4.0) {
        // The certifier wants more room than was thought: rough ground, or its own tolerance.
        factor *= 1.25;
        taut_.set_ground_factor(factor);
        taut_.set_reserve(factor * factor * factor);
        --k;
        continue;
      }
      if (!better && k > 0) return;
      if (taut.length_m > before_m * (1.0 - 1e-5)) return;
      before_m = taut.length_m;
      if (!taut_.refine(chain, 2e-6 * problem_.distance_m(), params_.most_points)) return;
    }
  }

  Result<bool> try_swarm(const swarm::AnyParams& params, double factor, std::uint64_t seed, int iterations,
                         const std::vector<std::vector<Vec3>>& guesses) {
    const swarm::Problem problem = problem_.in_box(factor);
    swarm::RunOptions options;
    options.stop = stop_;
    const auto wanted =
        static_cast<std::uint64_t>(params_.population) * static_cast<std::uint64_t>(iterations);
    if (left() <= kSpare) return true;
    options.stop.max_evaluations = std::min(wanted, left() - kSpare);
    options.stop.max_iterations = std::numeric_limits<std::uint64_t>::max();
    options.seed = seed;
    options.keep_history = false;
    options.guesses.resize(problem.dimension(), static_cast<Eigen::Index>(guesses.size()));
    const DetourEnds& ends = problem_.ends();
    for (std::size_t i = 0; i < guesses.size(); ++i) {
      options.guesses.col(static_cast<Eigen::Index>(i)) =
          problem_.encode(resample(ends.from_m, guesses[i], ends.to_m, problem_.waypoints()));
    }
    Result<swarm::Report> report = swarm::optimize(params, problem, options);
    if (!report) return report.error();
    evaluations_ += report->evaluations;
    chain_ = problem_.decode(report->best);
    chain_.insert(chain_.begin(), ends.from_m);
    chain_.push_back(ends.to_m);
    if (!found() || !params_.parts.polish) offer(chain_);
    if (!ended()) polish(chain_);
    return true;
  }

  /// Whether the best path is too long for a swarm of the problem's waypoints.
  bool is_long() const {
    return found() && best_.size() > 2 * static_cast<std::size_t>(problem_.waypoints()) &&
           !problem_.field().anything_moves();
  }

  /// Other ways along stretches of the best path; what they gain together is offered.
  Result<bool> try_stretches(const swarm::AnyParams& params) {
    chain_ = best_;
    bool shorter = false;
    for (std::size_t k = 0; k < best_.size() && !ended(); ++k) {
      if (params_.parts.tree) shorter = stretches_.try_tree(chain_, evaluations_) || shorter;
      if (!params_.parts.butterflies || k % kTreesPerSwarm != 0) continue;
      Result<bool> gained = stretches_.try_swarm(chain_, params, evaluations_);
      if (!gained) return gained.error();
      shorter = *gained || shorter;
    }
    if (shorter && !offer(chain_) && refused_) polish(chain_);
    return true;
  }

  /// The best path's waypoints.
  std::vector<Vec3> best() const { return {best_.begin() + 1, best_.end() - 1}; }

 private:
  const DetourProblem& problem_;
  const CorridorParams& params_;
  const StopCondition& stop_;
  const AcceptCorridor& accept_;
  Rng rng_;
  NearbySolids nearby_;
  Sidestep sidestep_;
  TautString taut_;
  StretchSearch stretches_;
  double steepest_;
  std::uint64_t evaluations_ = 0;
  double accepted_ = kInfinity;
  double least_violation_m_ = kInfinity;
  bool refused_ = false;
  std::vector<Vec3> chain_;  ///< being worked on, ends included
  std::vector<Vec3> best_;
};

Result<swarm::AnyParams> swarm_params_of(const swarm::AnyParams& defaults, const CorridorParams& params) {
  Result<swarm::AnyParams> swarm_params =
      swarm::with_settings(swarm::with_population(defaults, params.population), params.settings);
  if (!swarm_params) return swarm_params;
  if (auto* boa = std::get_if<swarm::BoaParams>(&*swarm_params); boa != nullptr && !params.parts.launcher) {
    boa->launcher.hop_share = std::numeric_limits<double>::max();
    boa->launcher.stall_iterations = std::numeric_limits<int>::max();
  }
  return swarm_params;
}

}  // namespace

Status validate(const CorridorParts& parts) {
  if (!parts.tree && !parts.butterflies) {
    return bad_input(
        "A search without its tree and without its butterflies has nothing to find a path with.");
  }
  return {};
}

Result<CorridorReport> search_corridor(const DetourProblem& problem, const CorridorParams& params,
                                       const StopCondition& stop, std::uint64_t seed,
                                       const std::vector<std::vector<Vec3>>& guesses,
                                       const AcceptCorridor& accept) {
  Result<swarm::AnyParams> algorithm = swarm::params_by_name(params.algorithm);
  if (!algorithm) return algorithm.error();
  if (Status status = validate(params.parts); !status) return status.error();
  const Result<swarm::AnyParams> swarm_params = swarm_params_of(*algorithm, params);
  if (!swarm_params) return swarm_params.error();

  Search search(problem, params, stop, seed, accept);
  const auto finished = [&] { return search.found() && params.idle_rounds == 0; };
  const auto report = [&] {
    return CorridorReport{stop.interrupted(), search.evaluations(),
                          search.found() ? 0.0 : search.least_violation_m()};
  };
  if (search.left() == 0 || search.ended()) return report();
  for (const auto& guess : guesses) {
    if (search.left() > kSpare) search.try_guess(guess);
  }
  if (params.parts.tree && !finished()) search.try_tree(0.0, kFirstLooks);
  int idle = 0;
  for (int round = 0; round < params.max_rounds && !finished(); ++round) {
    if (search.left() <= kSpare || search.ended()) break;
    const double before = search.accepted();
    if (search.is_long() && round % kStretchesEvery == kStretchesEvery - 1) {
      Result<bool> done = search.try_stretches(*swarm_params);
      if (!done) return done.error();
      idle = search.accepted() < before * (1.0 - 1e-4) ? 0 : idle + 1;
      if (idle >= params.idle_rounds) break;
      continue;
    }
    for (int k = 0; params.parts.tree && k < kTreesPerRound && !search.ended() && !finished(); ++k)
      search.try_tree(0.15 * (k + 1), kLooks);
    if (params.parts.butterflies && !search.ended() && !finished()) {
      std::vector<std::vector<Vec3>> starts;
      if (round % 2 == 0) starts = guesses;
      if (round % 2 == 1 && search.found()) starts.push_back(search.best());
      const auto at = static_cast<std::size_t>(round);
      const int iterations = at < kFirstIterations.size()
                                 ? std::min(kFirstIterations[at], params.iterations_per_round)
                                 : params.iterations_per_round;
      Result<bool> done =
          search.try_swarm(*swarm_params, kBoxFactors[at % kBoxFactors.size()],
                           seed + 0x9e3779b9ULL * static_cast<std::uint64_t>(round), iterations, starts);
      if (!done) return done.error();
    }
    if (!search.found()) continue;
    idle = search.accepted() < before * (1.0 - 1e-4) ? 0 : idle + 1;
    if (idle >= params.idle_rounds) break;
  }
  return report();
}

}  // namespace swallowtail::planner
