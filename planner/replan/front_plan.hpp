#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/replan/preset_plan.hpp"

namespace swallowtail::planner {

/// One path of a front: F1–F4 (cost/navigation.hpp), its places with both ends, and what the certifier says
/// of it once it has times.
struct FrontMember {
  Eigen::Vector4d objectives = Eigen::Vector4d::Zero();
  std::vector<Vec3> polyline;
  bool certified = false;
};

struct PlannedFront {
  std::vector<FrontMember> members;   ///< none dominates another; sorted by objectives
  double hypervolume = 0.0;           ///< of all members, from (1, 1, 1, 1)
  std::optional<std::size_t> picked;  ///< the compromise (swarm::MultiReport); none if there is no member
  std::optional<std::size_t> flown;   ///< which member the plan is; none if none is certified
};

struct FrontReport {
  PricedReport priced;
  std::optional<PlannedFront> front;  ///< none: the plan is plan_with_cost's
};

/// Whether an algorithm of that name can return a front; false for a name nobody knows.
bool returns_front(const std::string& algorithm);

/// Plans a Pareto front where algorithm and cost allow it: one that returns_front under preset NMOPSO without
/// weights of its own. Everything else, a blocked end included, is left to plan_with_cost; so is a scene that
/// navigation variables cannot take (an end off the band of heights or below or above an obstacle), and the
/// reason says so.
///
/// Every member is given times (time_route) and shown to the certifier. The plan is the picked member if that
/// one is certified, else the certified member nearest to the front's ideal point, by the rule that picks;
/// its terms are F1–F4, its cost their sum. Without any certified member the status is kNoneFound and
/// `attempt` is the picked one.
///
/// Every obstacle counts as an upright cylinder without end, where it stands at mission time 0, with its own
/// margin added; turn and climb limits beyond 80° count as 80°. S of F2 is CostSpec::danger_distance_m, where
/// that is 0 ten times the vehicle's clearance as in [NMOPSO]'s code, at least D/200. The population is the
/// algorithm's own unless the settings say otherwise. Without a limit in `stop`: kFrontEvaluations, for a
/// form as published kDefaultEvaluations. Errors: as plan_with_cost.
Result<FrontReport> plan_with_front(const std::shared_ptr<const World>& world, const PricedRequest& request,
                                    const StopCondition& stop, const Clock* clock = nullptr,
                                    const std::function<void(const PlanProgress&)>& observer = {});

inline constexpr std::uint64_t kFrontEvaluations = 10'000;

}  // namespace swallowtail::planner
