#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "planner/base/clock.hpp"
#include "tools/bench/core/convergence.hpp"
#include "tools/bench/plan/bench_case.hpp"

namespace swallowtail::bench {

/// What one run of one planner gave.
struct PlanRun {
  Curve curve;               ///< lengths of the free paths found, over the thread's CPU time
  std::vector<Vec3> path_m;  ///< the best of them, ends included; empty: none
  std::uint64_t evaluations = 0;
  double cpu_ms = 0.0;
  std::string failure;  ///< of a planner that could not be run at all
};

/// When a run ends, whichever comes first.
struct RunLimit {
  double cpu_s = std::numeric_limits<double>::infinity();
  std::uint64_t evaluations = std::numeric_limits<std::uint64_t>::max();  ///< OMPL: motions checked
};

/// A planner on the bench: one run on a case with a seed.
struct Subject {
  std::string name;
  std::string kind;  ///< "planner", "optimiser", "ompl", "pagmo"
  std::function<PlanRun(const PlanCase&, std::uint64_t seed, const RunLimit&)> run;
};

/// Keeps the best path of a run and its curve. CPU time counts from the making of this.
class Recorder {
 public:
  double cpu_ms() const { return 1e3 * (clock_.now_s() - started_s_); }
  /// A free path; kept if it is the shortest so far.
  void offer(std::span<const Vec3> path, double length_m, std::uint64_t evaluations,
             std::uint64_t iterations);
  double best_length_m() const { return best_length_m_; }
  PlanRun finish(std::uint64_t evaluations);

 private:
  ThreadCpuClock clock_;
  double started_s_ = clock_.now_s();
  double best_length_m_ = std::numeric_limits<double>::infinity();
  PlanRun run_;
};

/// Ours: `plan_path` and every optimiser of the registry that has one objective, on the preset "default".
std::vector<Subject> our_subjects();

/// `plan_path` whole, and without one of its parts at a time.
std::vector<Subject> ablation_subjects();

/// Those of the peers that this program was built with; `notes` gets a sentence for each, built or not.
std::vector<Subject> peer_subjects(std::vector<std::string>& notes);

}  // namespace swallowtail::bench
