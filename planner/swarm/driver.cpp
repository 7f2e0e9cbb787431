#include "planner/swarm/driver.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace swallowtail::swarm {

Status validate(const Problem& problem) {
  const Eigen::Index n = problem.lower.size();
  if (n < 1) return bad_input("The problem has no variables.");
  if (problem.upper.size() != n) {
    return bad_input("The problem has " + std::to_string(n) + " lower and " +
                     std::to_string(problem.upper.size()) + " upper bounds; they must be as many.");
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!std::isfinite(problem.lower[i]) || !std::isfinite(problem.upper[i])) {
      return bad_input("The bounds of variable " + std::to_string(i) + " are not finite.");
    }
    if (!(problem.lower[i] < problem.upper[i])) {
      return bad_input("The box of variable " + std::to_string(i) + " is empty: its lower bound is " +
                       std::to_string(problem.lower[i]) + ", its upper bound " +
                       std::to_string(problem.upper[i]) + ".");
    }
  }
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

namespace detail {

Status check(const Problem& problem, const RunOptions& options) {
  if (Status status = validate(problem); !status) return status;
  const StopCondition& stop = options.stop;
  const auto unlimited = std::numeric_limits<std::uint64_t>::max();
  if (stop.max_evaluations == unlimited && stop.max_iterations == unlimited &&
      stop.stop_requested == nullptr && !options.observer &&
      (stop.clock == nullptr || std::isinf(stop.deadline_s))) {
    return bad_input(
        "The run would never end: give it a deadline, a number of evaluations or of iterations.");
  }
  if (options.guesses.size() > 0 && options.guesses.rows() != problem.dimension()) {
    return bad_input("The guesses have " + std::to_string(options.guesses.rows()) +
                     " rows; the problem has " + std::to_string(problem.dimension()) + " variables.");
  }
  if (!options.guesses.allFinite()) return bad_input("A guess is not finite.");
  return {};
}

Run::Run(const Problem& problem, const RunOptions& options)
    : options_(options),
      evaluate_(problem, options.stop.max_evaluations),
      rng_(options.seed),
      started_s_(options.stop.clock != nullptr ? options.stop.clock->now_s() : 0.0),
      last_best_(std::numeric_limits<double>::infinity()) {}

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
    if (advice == Advice::kAccept) {
      report_.termination = Termination::kAccepted;
      report_.reason = "the observer accepts the result";
      return false;
    }
    if (advice == Advice::kAbort) {
      report_.termination = Termination::kAborted;
      report_.reason = "the observer gives up";
      return false;
    }
  }
  if (!options_.stop.reached(evaluate_.evaluations(), report_.iterations)) {
    ++report_.iterations;
    return true;
  }
  if (options_.stop.interrupted()) {
    report_.termination = Termination::kInterrupted;
    report_.reason = "interrupted";
  } else if (evaluate_.evaluations() >= options_.stop.max_evaluations) {
    report_.reason = "evaluations used up";
  } else if (report_.iterations >= options_.stop.max_iterations) {
    report_.reason = "iterations used up";
  } else {
    report_.termination = Termination::kDeadline;
    report_.reason = "deadline reached";
  }
  return false;
}

Report Run::finish() {
  report_.best = evaluate_.best();
  report_.best_cost = evaluate_.best_cost();
  report_.evaluations = evaluate_.evaluations();
  return std::move(report_);
}

}  // namespace detail
}  // namespace swallowtail::swarm
