#include "planner/replan/corridor_search.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "planner/replan/descent.hpp"

namespace swallowtail::planner {
namespace {

/// Size of the box in units of the natural one, by round.
constexpr std::array kBoxFactors{1.0, 1.0, 2.0, 1.0, 4.0, 1.5};
/// A better path must be better by this share to be offered again.
constexpr double kGain = 1e-6;
constexpr std::uint64_t kDescentEvaluations = 400;

class Search {
 public:
  Search(const DetourProblem& problem, const StopCondition& stop, const AcceptCorridor& accept)
      : problem_(problem), stop_(stop), accept_(accept) {}

  std::uint64_t evaluations() const { return evaluations_; }
  std::uint64_t left() const {
    return stop_.max_evaluations > evaluations_ ? stop_.max_evaluations - evaluations_ : 0;
  }
  bool found() const { return accepted_ < std::numeric_limits<double>::infinity(); }
  double accepted() const { return accepted_; }
  const Eigen::VectorXd& best() const { return best_; }
  double least_violation_m() const { return least_violation_m_; }

  void offer(const Eigen::VectorXd& x, std::uint64_t running_evaluations) {
    const DetourProblem::Cost cost = problem_.cost(x);
    least_violation_m_ = std::min(least_violation_m_, cost.violation_m);
    const double value = problem_.value(cost);
    if (cost.violation_m > 0.0 || value >= accepted_ * (1.0 - kGain)) return;
    if (!accept_(Corridor{problem_.decode(x), cost, value}, evaluations_ + running_evaluations)) return;
    accepted_ = value;
    best_ = x;
  }

  Result<bool> round(const swarm::AnyParams& params, double factor, std::uint64_t seed,
                     std::uint64_t evaluations, const std::vector<Eigen::VectorXd>& guesses) {
    const swarm::Problem problem = problem_.in_box(factor);
    swarm::RunOptions options;
    options.stop = stop_;
    options.stop.max_evaluations = std::min(evaluations, left());
    options.stop.max_iterations = std::numeric_limits<std::uint64_t>::max();
    options.seed = seed;
    options.keep_history = false;
    options.guesses.resize(problem.dimension(), static_cast<Eigen::Index>(guesses.size()));
    for (std::size_t i = 0; i < guesses.size(); ++i)
      options.guesses.col(static_cast<Eigen::Index>(i)) = guesses[i];
    options.observer = [&](const swarm::Progress& progress) {
      if (progress.improved && !found()) offer(progress.best, progress.evaluations);
      return swarm::Advice::kContinue;
    };
    Result<swarm::Report> report = swarm::optimize(params, problem, options);
    if (!report) return report.error();
    evaluations_ += report->evaluations;
    offer(report->best, 0);
    if (left() < 2 || stop_.reached(evaluations_, 0)) return true;
    const DescentResult descent = descend(problem_, report->best, std::min(left(), kDescentEvaluations));
    evaluations_ += descent.evaluations;
    offer(descent.x, 0);
    return true;
  }

 private:
  const DetourProblem& problem_;
  const StopCondition& stop_;
  const AcceptCorridor& accept_;
  std::uint64_t evaluations_ = 0;
  double accepted_ = std::numeric_limits<double>::infinity();
  double least_violation_m_ = std::numeric_limits<double>::infinity();
  Eigen::VectorXd best_;
};

}  // namespace

Result<CorridorReport> search_corridor(const DetourProblem& problem, const CorridorParams& params,
                                       const StopCondition& stop, std::uint64_t seed,
                                       const std::vector<std::vector<Vec3>>& guesses,
                                       const AcceptCorridor& accept) {
  Result<swarm::AnyParams> algorithm = swarm::params_by_name(params.algorithm);
  if (!algorithm) return algorithm.error();
  const swarm::AnyParams swarm_params = swarm::with_population(*algorithm, params.population);
  const auto round_evaluations =
      static_cast<std::uint64_t>(params.population) * static_cast<std::uint64_t>(params.iterations_per_round);

  Search search(problem, stop, accept);
  int idle = 0;
  for (int round = 0; round < params.max_rounds; ++round) {
    if (search.left() == 0 || stop.reached(search.evaluations(), 0)) break;
    const double before = search.accepted();
    std::vector<Eigen::VectorXd> starts;
    if (round % 2 == 0) {
      for (const auto& guess : guesses) starts.push_back(problem.encode(guess));
    } else if (search.found()) {
      starts.push_back(search.best());
    }
    const double factor = kBoxFactors[static_cast<std::size_t>(round) % kBoxFactors.size()];
    Result<bool> done =
        search.round(swarm_params, factor, seed + 0x9e3779b9ULL * static_cast<std::uint64_t>(round),
                     round_evaluations, starts);
    if (!done) return done.error();
    if (!search.found()) continue;
    idle = search.accepted() < before * (1.0 - 1e-4) ? 0 : idle + 1;
    if (idle >= params.idle_rounds) break;
  }
  return CorridorReport{stop.interrupted(), search.evaluations(),
                        search.found() ? 0.0 : search.least_violation_m()};
}

}  // namespace swallowtail::planner
