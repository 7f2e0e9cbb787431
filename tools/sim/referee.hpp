#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "idl/data/types.hpp"
#include "tools/sim/aircraft.hpp"

namespace swallowtail::sim {

/// How a mission ended. `reason` is "completed" or a phrase that says why not.
struct Outcome {
  bool completed = false;
  std::string reason;
};

/// What a coverage plan says about being done.
struct PlanSummary {
  std::uint32_t revision = 0;
  std::uint32_t legs_total = 0;
  bool complete = false;
  std::string reason;
};

/// Decides when a mission is over:
/// - a coverage is completed when all legs are flown, the plan says that nothing is left out, and the
/// aircraft has stood on the ground for `grace_s`, in which no new leg came;
/// - a goal is completed when the aircraft rests within kGoal_m of it;
/// - it fails when the battery runs out aloft, when the planner has had no safe path for kNoPath_s, when
/// nothing has happened for kStuck_s, or at `max_time_s`.
class Referee {
 public:
  static constexpr double kGoal_m = 1.0;
  static constexpr double kNoPath_s = 120.0;
  static constexpr double kStuck_s = 900.0;
  static constexpr double kIncomplete_s = 60.0;  ///< for coverage to find a place for what it left out

  struct Rules {
    std::optional<Vec3> goal_m;  ///< none: a coverage
    double max_time_s = std::numeric_limits<double>::infinity();
    double grace_s = 5.0;
  };

  explicit Referee(const Rules& rules) : rules_(rules) {}

  void see_plan(const PlanSummary& plan) { plan_ = plan; }
  void see_verdict(data::PathVerdict verdict, double time_s);

  /// Once per step, in time.
  std::optional<Outcome> judge(const Motion& motion, double energy);

 private:
  std::optional<Outcome> judge_goal(const Motion& motion) const;
  std::optional<Outcome> judge_coverage(const Motion& motion);
  bool is_stuck(const Motion& motion, double energy);

  const Rules rules_;
  PlanSummary plan_;
  std::optional<double> no_path_since_s_;
  std::optional<double> all_flown_since_s_;
  Motion anchor_;  ///< when something last happened
  double anchor_energy_ = 0.0;
};

}  // namespace swallowtail::sim
