#include "planner/swarm/tuning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

namespace swallowtail::swarm {
namespace {

constexpr int kRounds = 2;
constexpr double kLeastGain = 1e-6;  // share of the cost that a setting must gain to be kept
constexpr double kConverged = 1e-3;  // share of the cost that later generations may still gain
constexpr double kFactors[] = {0.25, 0.5, 1.5, 2.0, 4.0};
constexpr double kShares[] = {0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0};
constexpr const char* kMidpoints = "midpoints";

/// What the runs of one setting gave.
struct Outcome {
  double median_cost = std::numeric_limits<double>::infinity();
  std::uint64_t generations = 0;
  std::uint64_t evaluations = 0;
  std::optional<Error> error;  // of the first run that failed
};

std::uint64_t generations_of(const Report& report) {
  const double enough = report.best_cost + kConverged * std::abs(report.best_cost);
  for (std::size_t i = 0; i < report.history.size(); ++i) {
    if (report.history[i].best_cost <= enough) return i;
  }
  return report.iterations;
}

class Search {
 public:
  Search(const AnyParams& start, const TuningRun& run, const TuningOptions& options)
      : run_(run), options_(options), params_(start), midpoints_(options.midpoints) {}

  Result<TuningReport> go() {
    const Outcome first = measure(params_, midpoints_);
    if (first.error) return *first.error;
    report_.median_before = first.median_cost;
    take(first);
    bool improved = true;
    for (int round = 0; round < kRounds && improved; ++round) improved = sweep_all();
    report_.params = params_;
    report_.midpoints = midpoints_;
    report_.generations = best_.generations;
    report_.median_after = best_.median_cost;
    report_.interrupted = stopped();
    return std::move(report_);
  }

 private:
  bool stopped() const {
    return options_.stop_requested != nullptr && options_.stop_requested->load(std::memory_order_relaxed);
  }

  void take(const Outcome& outcome) { best_ = outcome; }

  Outcome measure(const AnyParams& params, int midpoints) {
    std::vector<std::optional<Result<Report>>> reports(static_cast<std::size_t>(options_.seeds));
    std::atomic<int> next{0};
    const auto work = [&] {
      for (int i = next++; i < options_.seeds; i = next++) {
        reports[static_cast<std::size_t>(i)] =
            run_(params, midpoints, options_.seed + static_cast<std::uint64_t>(i));
      }
    };
    std::vector<std::thread> threads;
    for (int i = 1; i < std::min(options_.threads, options_.seeds); ++i) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();

    Outcome outcome;
    std::vector<double> costs;
    for (const auto& report : reports) {
      if (!report->ok()) {
        outcome.error = report->error();
        return outcome;
      }
      costs.push_back((*report)->best_cost);
      outcome.generations = std::max(outcome.generations, generations_of(report->value()));
      outcome.evaluations += (*report)->evaluations;
    }
    std::sort(costs.begin(), costs.end());
    const std::size_t half = costs.size() / 2;
    outcome.median_cost = costs.size() % 2 == 1 ? costs[half] : 0.5 * (costs[half - 1] + costs[half]);
    report_.evaluations += outcome.evaluations;
    return outcome;
  }

  bool is_better(const Outcome& outcome) const {
    return outcome.median_cost < best_.median_cost - kLeastGain * std::abs(best_.median_cost) ||
           (std::isfinite(outcome.median_cost) && !std::isfinite(best_.median_cost));
  }

  /// Tries one setting; true if it is kept.
  bool attempt(const std::string& name, double value) {
    AnyParams params = params_;
    int midpoints = midpoints_;
    if (name == kMidpoints) {
      midpoints = static_cast<int>(value);
    } else if (!set(parameters(params), name, value)) {
      return false;
    }
    const Outcome outcome = measure(params, midpoints);
    if (stopped()) return false;
    const bool kept = is_better(outcome);
    report_.steps.push_back({name, value, outcome.median_cost, kept});
    if (options_.observer) options_.observer(report_.steps.back());
    if (!kept) return false;
    params_ = std::move(params);
    midpoints_ = midpoints;
    take(outcome);
    return true;
  }

  bool sweep(const std::string& name, const std::vector<double>& values) {
    bool improved = false;
    for (const double value : values) {
      if (!stopped()) improved = attempt(name, value) || improved;
    }
    return improved;
  }

  std::vector<double> values_of(const Parameter& parameter) const {
    std::vector<double> values;
    const auto add = [&](double value) {
      value = std::clamp(parameter.is_integer() ? std::round(value) : value, parameter.min, parameter.max);
      if (value != parameter.get()) values.push_back(value);
    };
    if (!parameter.is_integer() && parameter.min == 0.0 && parameter.max == 1.0) {
      for (const double share : kShares) add(share);
    } else {
      for (const double factor : kFactors) add(factor * parameter.get());
    }
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
  }

  bool sweep_parameter(const std::string& name) {
    for (const Parameter& parameter : parameters(params_)) {
      if (parameter.name == name) return sweep(name, values_of(parameter));
    }
    return false;
  }

  bool sweep_all() {
    bool improved = sweep_parameter("population");
    std::vector<double> midpoints;
    for (int k = 1; k <= options_.most_midpoints; k += k < 6 ? 1 : k < 10 ? 2 : 3) {
      if (k != midpoints_) midpoints.push_back(k);
    }
    improved = sweep(kMidpoints, midpoints) || improved;
    std::vector<std::string> others;
    for (const Parameter& parameter : parameters(params_)) others.emplace_back(parameter.name);
    for (const std::string& name : others) {
      if (name != "population") improved = sweep_parameter(name) || improved;
    }
    return improved;
  }

  const TuningRun& run_;
  const TuningOptions& options_;
  AnyParams params_;
  int midpoints_;
  Outcome best_;
  TuningReport report_;
};

}  // namespace

Result<TuningReport> tune(const AnyParams& start, const TuningRun& run, const TuningOptions& options) {
  if (options.seeds < 1 || options.seeds > 1000) return bad_input("The number of seeds must be 1 to 1000.");
  if (options.threads < 1 || options.threads > 256) {
    return bad_input("The number of threads must be 1 to 256.");
  }
  if (options.midpoints < 1 || options.most_midpoints < 0 || options.most_midpoints > 64) {
    return bad_input("The number of midpoints must be 1 to 64.");
  }
  return Search(start, run, options).go();
}

}  // namespace swallowtail::swarm
