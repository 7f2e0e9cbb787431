#include "planner/swarm/driver.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace swallowtail::swarm {

namespace detail {

Status check_box(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const Eigen::Index n = lower.size();
  if (n < 1) return bad_input("The problem has no variables.");
  if (upper.size() != n) {
    return bad_input("The problem has " + std::to_string(n) + " lower and " + std::to_string(upper.size()) +
                     " upper bounds; they must be as many.");
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!std::isfinite(lower[i]) || !std::isfinite(upper[i])) {
      return bad_input("The bounds of variable " + std::to_string(i) + " are not finite.");
    }
    if (!(lower[i] < upper[i])) {
      return bad_input("The box of variable " + std::to_string(i) + " is empty: its lower bound is " +
                       std::to_string(lower[i]) + ", its upper bound " + std::to_string(upper[i]) + ".");
    }
  }
  return {};
}

}  // namespace detail

Status validate(const Problem& problem) {
  if (Status status = detail::check_box(problem.lower, problem.upper); !status) return status;
  const Eigen::Index n = problem.dimension();
  if (!problem.evaluate) return bad_input("The problem has no function to evaluate.");
  if (problem.waypoints && n % 3 != 0) {
    return bad_input("A problem of waypoints has three variables for each, not " + std::to_string(n) + ".");
  }
  return {};
}

Evaluator::Evaluator(const Problem& problem, std::uint64_t max_evaluations)
    : problem_(problem),
      max_evaluations_(max_evaluations),
      best_(Eigen::VectorXd::Zero(problem.dimension())) {}

void Evaluator::operator()(Candidates candidates, Costs costs) {
  const auto left = static_cast<std::uint64_t>(max_evaluations_ - evaluations_);
  const auto asked = static_cast<std::uint64_t>(candidates.cols());
  const auto n = static_cast<Eigen::Index>(std::min(left, asked));
  costs.setConstant(std::numeric_limits<double>::infinity());
  if (n == 0) return;
  problem_.evaluate(candidates.leftCols(n), costs.head(n));
  evaluations_ += static_cast<std::uint64_t>(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (std::isnan(costs[i])) costs[i] = std::numeric_limits<double>::infinity();
    if (costs[i] < best_cost_) {
      best_cost_ = costs[i];
      best_ = candidates.col(i);
    }
  }
}

void Evaluator::reassess() {
  if (std::isinf(best_cost_) || evaluations_ >= max_evaluations_) return;
  problem_.evaluate(best_, best_cost_now_);
  ++evaluations_;
  best_cost_ = std::isnan(best_cost_now_[0]) ? std::numeric_limits<double>::infinity() : best_cost_now_[0];
}

namespace detail {

Status check_start(const StopCondition& stop, const Eigen::MatrixXd& guesses, Eigen::Index dimension,
                   bool observed) {
  const auto unlimited = std::numeric_limits<std::uint64_t>::max();
  if (stop.max_evaluations == unlimited && stop.max_iterations == unlimited &&
      stop.stop_requested == nullptr && !observed && (stop.clock == nullptr || std::isinf(stop.deadline_s))) {
    return bad_input(
        "The run would never end: give it a deadline, a number of evaluations or of iterations.");
  }
  if (guesses.size() > 0 && guesses.rows() != dimension) {
    return bad_input("The guesses have " + std::to_string(guesses.rows()) + " rows; the problem has " +
                     std::to_string(dimension) + " variables.");
  }
  if (!guesses.allFinite()) return bad_input("A guess is not finite.");
  return {};
}

Ending ending_of(const StopCondition& stop, std::uint64_t evaluations, std::uint64_t iterations) {
  if (stop.interrupted()) return {Termination::kInterrupted, "interrupted"};
  if (evaluations >= stop.max_evaluations) return {Termination::kBudget, "evaluations used up"};
  if (iterations >= stop.max_iterations) return {Termination::kBudget, "iterations used up"};
  return {Termination::kDeadline, "deadline reached"};
}

Ending ending_of(Advice advice) {
  if (advice == Advice::kAccept) return {Termination::kAccepted, "the observer accepts the result"};
  return {Termination::kAborted, "the observer gives up"};
}

Status check(const Problem& problem, const RunOptions& options) {
  if (Status status = validate(problem); !status) return status;
  return check_start(options.stop, options.guesses, problem.dimension(), options.observer != nullptr);
}

Run::Run(const Problem& problem, const RunOptions& options)
    : problem_(problem),
      options_(options),
      evaluate_(problem, options.stop.max_evaluations),
      rng_(options.seed),
      started_s_(options.stop.clock != nullptr ? options.stop.clock->now_s() : 0.0),
      last_best_(std::numeric_limits<double>::infinity()) {}

bool Run::costs_change() {
  if (!problem_.begin_iteration || !problem_.begin_iteration(report_.iterations)) return false;
  evaluate_.reassess();
  return true;
}

bool Run::proceed() {
  const Clock* clock = options_.stop.clock;
  if (options_.keep_history) {
    report_.history.push_back({evaluate_.evaluations(), clock != nullptr ? clock->now_s() - started_s_ : 0.0,
                               evaluate_.best_cost()});
  }
  if (options_.observer) {
    const Progress progress{report_.iterations, evaluate_.evaluations(), evaluate_.best_cost(),
                            evaluate_.best_cost() < last_best_, evaluate_.best()};
    last_best_ = evaluate_.best_cost();
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

Report Run::finish() {
  report_.termination = ending_.termination;
  report_.reason = ending_.reason;
  report_.best = evaluate_.best();
  report_.best_cost = evaluate_.best_cost();
  report_.evaluations = evaluate_.evaluations();
  return std::move(report_);
}

}  // namespace detail
}  // namespace swallowtail::swarm
