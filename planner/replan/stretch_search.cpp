#include "planner/replan/stretch_search.hpp"

#include <algorithm>
#include <limits>

namespace swallowtail::planner {
namespace {

constexpr std::uint64_t kMostHops = 7;
constexpr std::uint64_t kLooks = 150;
constexpr std::uint64_t kPolishEvaluations = 150;
constexpr int kSwarmIterations = 4;
constexpr double kGain = 1e-6;

}  // namespace

StretchSearch::StretchSearch(const DetourProblem& problem, const CorridorParams& params, Sidestep& sidestep,
                             TautString& taut, Rng& rng)
    : problem_(problem),
      params_(params),
      sidestep_(sidestep),
      taut_(taut),
      rng_(rng),
      steepest_(steepest_slope(problem.limits())) {}

StretchSearch::Stretch StretchSearch::pick(const std::vector<Vec3>& chain) {
  const std::size_t hops = 2 + rng_.below(kMostHops - 1);
  const std::size_t first = rng_.below(chain.size() - 2);
  return {first, std::min(first + hops, chain.size() - 1)};
}

bool StretchSearch::replace(std::vector<Vec3>& chain, const Stretch& stretch, std::uint64_t& evaluations) {
  const auto from = chain.begin() + static_cast<std::ptrdiff_t>(stretch.first);
  const auto to = chain.begin() + static_cast<std::ptrdiff_t>(stretch.last);
  double old_m = 0.0;
  for (auto p = from; p != to; ++p) old_m += flown_length_m(*(p + 1) - *p, steepest_);
  if (params_.parts.polish && way_.size() > 2) {
    const TautResult taut = taut_.tighten(way_, 0.0, kPolishEvaluations, old_m);
    evaluations += taut.evaluations * way_.size() / chain.size();
    if (taut.given_up) return false;
  }
  if (flown_length_m(way_, steepest_) > old_m - kGain * problem_.distance_m()) return false;
  const std::vector<Vec3> flown = as_flown(way_, steepest_);
  for (std::size_t i = 1; i < flown.size(); ++i) {
    if (!sidestep_.clear(flown[i - 1], flown[i], 0.0)) return false;
  }
  const auto gap = chain.erase(from + 1, to);
  chain.insert(gap, way_.begin() + 1, way_.end() - 1);
  return true;
}

bool StretchSearch::try_tree(std::vector<Vec3>& chain, std::uint64_t& evaluations) {
  const Stretch stretch = pick(chain);
  const double noise = rng_.uniform() < 0.5 ? 0.0 : 0.3 * rng_.uniform();
  sidestep_.find(chain[stretch.first], chain[stretch.last], 0.0, noise, rng_, kLooks, way_);
  evaluations += 1 + sidestep_.looks() / chain.size();
  return !way_.empty() && replace(chain, stretch, evaluations);
}

Result<bool> StretchSearch::try_swarm(std::vector<Vec3>& chain, const swarm::AnyParams& params,
                                      std::uint64_t& evaluations) {
  const Stretch stretch = pick(chain);
  DetourEnds ends;
  ends.from_m = chain[stretch.first];
  ends.to_m = chain[stretch.last];
  const DetourProblem problem(problem_.field(), problem_.limits(), ends, problem_.waypoints(),
                              problem_.objective());
  const swarm::Problem in_box = problem.in_box(1.0);
  swarm::RunOptions options;
  options.stop.max_evaluations = static_cast<std::uint64_t>(params_.population) * kSwarmIterations;
  options.seed = rng_();
  options.keep_history = false;
  const std::vector<Vec3> old(chain.begin() + static_cast<std::ptrdiff_t>(stretch.first) + 1,
                              chain.begin() + static_cast<std::ptrdiff_t>(stretch.last));
  options.guesses = problem.encode(resample(ends.from_m, old, ends.to_m, problem.waypoints()));
  Result<swarm::Report> report = swarm::optimize(params, in_box, options);
  if (!report) return report.error();
  evaluations += 1 + report->evaluations * static_cast<std::uint64_t>(problem.waypoints()) / chain.size();
  way_ = problem.decode(report->best);
  way_.insert(way_.begin(), ends.from_m);
  way_.push_back(ends.to_m);
  return replace(chain, stretch, evaluations);
}

}  // namespace swallowtail::planner
