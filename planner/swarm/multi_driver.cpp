#include "planner/swarm/multi_driver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "planner/swarm/hypervolume.hpp"

namespace swallowtail::swarm {
namespace {

constexpr Eigen::Index kMaxMeasured = 4;  // objectives that hypervolume() can take

/// What the archive draws from must not be what the algorithm draws from.
constexpr std::uint64_t kArchiveStream = 1;

Front sorted_front(const ParetoArchive& archive) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(archive.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(), [&archive](Eigen::Index a, Eigen::Index b) {
    const auto x = archive.objectives(a);
    const auto y = archive.objectives(b);
    return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end());
  });
  Front front;
  front.decisions = archive.decisions()(Eigen::all, order);
  front.objectives = archive.objectives()(Eigen::all, order);
  return front;
}

}  // namespace

Status validate(const MultiProblem& problem) {
  if (Status status = detail::check_box(problem.lower, problem.upper); !status) return status;
  const Eigen::Index m = problem.objectives;
  if (m < 1 || m > MultiProblem::kMaxObjectives) {
    return bad_input("The problem has " + std::to_string(m) + " objectives; it must be 1 to " +
                     std::to_string(MultiProblem::kMaxObjectives) + ".");
  }
  if (!problem.evaluate) return bad_input("The problem has no function to evaluate.");
  const Eigen::Index measured = problem.reference.size();
  if (measured == 0) return {};
  if (measured != m) {
    return bad_input("The reference point has " + std::to_string(measured) + " coordinates for " +
                     std::to_string(m) + " objectives.");
  }
  if (m > kMaxMeasured) {
    return bad_input("The hypervolume of " + std::to_string(m) + " objectives cannot be measured, only of " +
                     std::to_string(kMaxMeasured) + " at most.");
  }
  if (!problem.reference.allFinite()) return bad_input("The reference point is not finite.");
  return {};
}

MultiEvaluator::MultiEvaluator(const MultiProblem& problem, const ArchiveParams& archive,
                               std::uint64_t max_evaluations, std::uint64_t seed)
    : problem_(problem),
      archive_(archive, problem.dimension(), problem.objectives),
      rng_(Rng(seed).split(kArchiveStream)),
      max_evaluations_(max_evaluations) {}

void MultiEvaluator::operator()(Candidates candidates, Objectives objectives) {
  const auto left = static_cast<std::uint64_t>(max_evaluations_ - evaluations_);
  const auto asked = static_cast<std::uint64_t>(candidates.cols());
  const auto n = static_cast<Eigen::Index>(std::min(left, asked));
  objectives.setConstant(std::numeric_limits<double>::infinity());
  taken_.assign(static_cast<std::size_t>(asked), 0);
  if (n == 0) return;
  problem_.evaluate(candidates.leftCols(n), objectives.leftCols(n));
  evaluations_ += static_cast<std::uint64_t>(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (double& value : objectives.col(i)) {
      if (std::isnan(value)) value = std::numeric_limits<double>::infinity();
    }
    if (!archive_.offer(candidates.col(i), objectives.col(i), rng_)) continue;
    taken_[static_cast<std::size_t>(i)] = 1;
    ++accepted_;
  }
}

Eigen::VectorXd distances_to_ideal(const Front& front) {
  if (front.size() == 0) return {};
  const Eigen::VectorXd ideal = front.objectives.rowwise().minCoeff();
  Eigen::VectorXd extent = front.objectives.rowwise().maxCoeff() - ideal;
  for (double& e : extent) e = e > 0.0 ? e : 1.0;
  return ((front.objectives.colwise() - ideal).array().colwise() / extent.array()).matrix().colwise().norm();
}

Eigen::Index pick_compromise(const Front& front) {
  if (front.size() == 0) return -1;
  Eigen::Index nearest = 0;
  distances_to_ideal(front).minCoeff(&nearest);
  return nearest;
}

namespace detail {

Status check(const MultiProblem& problem, const MultiRunOptions& options) {
  if (Status status = validate(problem); !status) return status;
  return check_start(options.stop, options.guesses, problem.dimension(), options.observer != nullptr);
}

MultiRun::MultiRun(const MultiProblem& problem, const ArchiveParams& archive, const MultiRunOptions& options)
    : problem_(problem),
      options_(options),
      evaluate_(problem, archive, options.stop.max_evaluations, options.seed),
      rng_(options.seed),
      started_s_(options.stop.clock != nullptr ? options.stop.clock->now_s() : 0.0) {}

void MultiRun::record() {
  const Clock* clock = options_.stop.clock;
  const ParetoArchive& archive = evaluate_.archive();
  report_.history.push_back(
      {evaluate_.evaluations(), clock != nullptr ? clock->now_s() - started_s_ : 0.0,
       problem_.reference.size() > 0 ? hypervolume(archive.objectives(), problem_.reference) : 0.0,
       archive.size()});
}

bool MultiRun::proceed() {
  if (options_.history_every > 0 && report_.iterations % options_.history_every == 0) record();
  if (options_.observer) {
    const MultiProgress progress{report_.iterations, evaluate_.evaluations(),
                                 evaluate_.accepted() != accepted_before_, evaluate_.archive()};
    accepted_before_ = evaluate_.accepted();
    const Advice advice = options_.observer(progress);
    if (advice != Advice::kContinue) {
      ending_ = ending_of(advice);
      return false;
    }
  }
  if (options_.stop.reached(evaluate_.evaluations(), report_.iterations)) {
    ending_ = ending_of(options_.stop, evaluate_.evaluations(), report_.iterations);
    return false;
  }
  ++report_.iterations;
  return true;
}

MultiReport MultiRun::finish() {
  report_.termination = ending_.termination;
  report_.reason = ending_.reason;
  report_.front = sorted_front(evaluate_.archive());
  report_.compromise = pick_compromise(report_.front);
  report_.evaluations = evaluate_.evaluations();
  if (report_.history.empty() || report_.history.back().evaluations != report_.evaluations) record();
  report_.hypervolume = report_.history.back().hypervolume;
  return std::move(report_);
}

}  // namespace detail
}  // namespace swallowtail::swarm
