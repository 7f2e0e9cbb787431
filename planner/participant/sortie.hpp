#pragma once

#include <cstdint>
#include <vector>

#include "idl/data/types.hpp"
#include "planner/path/path.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::planner {

/// A sortie begins and ends on the ground.
struct Sortie {
  std::uint32_t first_leg = 0;  ///< the first leg flown in it
  bool hops_to_entry =
      false;  ///< only flies to where its first leg begins and lands there [COV Tab. 2, F-DUFDU]
};

/// Where a route begins.
struct RouteStart {
  Vec3 position_m = Vec3::Zero();
  bool on_ground = false;
  std::uint32_t leg = 0;     ///< flown now or next
  bool leg_started = false;  ///< its entry has been passed
};

/// The corners of a way that lie ahead of a position near it, its last point not included.
std::vector<Vec3> corners_ahead(const std::vector<Vec3>& way, const Vec3& position_m);

/// The sortie that begins on the ground at `position_m` with the leg `next_leg`.
Sortie sortie_from(const data::CoveragePlan& plan, std::uint32_t next_leg, const Vec3& position_m);

/// The rest of a sortie as a route: take-off, strips, transfers with the bends of their ways, and the landing
/// that the plan asks for. Of a way that is under way only what lies ahead. Never empty unless the plan is.
/// Legs beyond kMaxLegsPerRoute are left for later: the route then ends in the air.
std::vector<RoutePoint> sortie_route(const data::CoveragePlan& plan, const Sortie& sortie,
                                     const RouteStart& start, const Terrain& terrain,
                                     const VehicleLimits& limits);

/// Whether both plans ask for the same flight from `leg` to the end of its sortie.
bool same_ahead(const data::CoveragePlan& a, const data::CoveragePlan& b, std::uint32_t leg);

/// Where the way to the goal begins: the start, or the end of the take-off from it.
Vec3 goal_way_start(const data::Goal& goal, const RouteStart& start, const Terrain& terrain,
                    const VehicleLimits& limits);

/// Take-off if on the ground, then round `corners` to the goal and a hold there of `hold_s`.
std::vector<RoutePoint> goal_route(const data::Goal& goal, const RouteStart& start, const Terrain& terrain,
                                   const VehicleLimits& limits, const std::vector<Vec3>& corners,
                                   double hold_s);

inline constexpr std::uint32_t kMaxLegsPerRoute = 300;

}  // namespace swallowtail::planner
