#include "planner/participant/sortie.hpp"

#include <algorithm>

#include "planner/participant/convert.hpp"

namespace swallowtail::planner {
namespace {

using data::Transfer;

/// Nearer than this to a strip counts as on it.
constexpr double kOnStrip_m = 0.3;

bool lands_at_exit(Transfer transfer) {
  return transfer == Transfer::kFDUF || transfer == Transfer::kFDUFDU || transfer == Transfer::kFDTU ||
         transfer == Transfer::kEnd;
}

Vec3 ground_below(const Vec3& p, const Terrain& terrain) {
  return {p.x(), p.y(), terrain.height_at(p.x(), p.y())};
}

class RouteWriter {
 public:
  RouteWriter(const data::CoveragePlan& plan, const Terrain& terrain, const VehicleLimits& limits)
      : plan_(plan), terrain_(terrain), limits_(limits) {}

  std::vector<RoutePoint> take() { return std::move(route_); }

  void go(const Vec3& p, Phase phase, std::uint32_t leg) { route_.push_back({p, phase, leg, 0.0}); }

  void take_off(const Vec3& ground, double height_m, std::uint32_t leg) {
    const double least = ground.z() + 1.5 * limits_.clearance_m();
    go({ground.x(), ground.y(), std::max(height_m, least)}, Phase::kTakeOff, leg);
  }

  void land(const Vec3& above, std::uint32_t leg) {
    go(above, Phase::kTransfer, leg);
    go(ground_below(above, terrain_), Phase::kLanding, leg);
  }

  void fly_leg(std::uint32_t i, const RouteStart& start) {
    const data::Leg& leg = plan_.legs[i];
    const Vec3 entry = to_vec(leg.entry);
    const Vec3 exit = to_vec(leg.exit);
    const Phase phase = leg.kind == data::LegKind::kCover ? Phase::kCover : Phase::kTransfer;
    if (i != start.leg || !start.leg_started) {
      go(entry, Phase::kTransfer, i);
    } else {
      const Vec3 strip = exit - entry;
      const double share =
          strip.squaredNorm() > 0.0
              ? std::clamp((start.position_m - entry).dot(strip) / strip.squaredNorm(), 0.0, 1.0)
              : 1.0;
      const Vec3 nearest = entry + share * strip;
      if ((nearest - start.position_m).norm() > kOnStrip_m) go(nearest, Phase::kTransfer, i);
    }
    go(exit, phase, i);
  }

 private:
  const data::CoveragePlan& plan_;
  const Terrain& terrain_;
  const VehicleLimits& limits_;
  std::vector<RoutePoint> route_;
};

}  // namespace

Sortie sortie_from(const data::CoveragePlan& plan, std::uint32_t next_leg, const Vec3& position_m) {
  Sortie sortie{next_leg, false};
  if (next_leg == 0 || next_leg >= plan.legs.size()) return sortie;
  const data::Leg& before = plan.legs[next_leg - 1];
  const auto away = [&](const data::Vec3& p) { return (to_vec(p) - position_m).head<2>().norm(); };
  sortie.hops_to_entry =
      before.transfer == Transfer::kFDUFDU && away(before.exit) < away(plan.legs[next_leg].entry);
  return sortie;
}

std::vector<RoutePoint> sortie_route(const data::CoveragePlan& plan, const Sortie& sortie,
                                     const RouteStart& start, const Terrain& terrain,
                                     const VehicleLimits& limits) {
  RouteWriter route(plan, terrain, limits);
  if (plan.legs.empty()) return {};
  const auto count = static_cast<std::uint32_t>(plan.legs.size());
  const std::uint32_t leg = start.leg;
  if (!start.on_ground && !start.leg_started && leg > 0 && (leg > sortie.first_leg || leg >= count)) {
    const data::Leg& before = plan.legs[std::min(leg, count) - 1];
    if (leg >= count || lands_at_exit(before.transfer)) {
      route.land(to_vec(before.exit), std::min(leg, count) - 1);
      return route.take();
    }
    if (before.transfer == Transfer::kFFDU) {
      route.land(to_vec(plan.legs[leg].entry), leg);
      return route.take();
    }
  }
  if (leg >= count) return route.take();
  if (start.on_ground) route.take_off(start.position_m, plan.legs[leg].entry.z_m, leg);
  if (sortie.hops_to_entry && leg == sortie.first_leg && !start.leg_started) {
    route.land(to_vec(plan.legs[leg].entry), leg);
    return route.take();
  }
  for (std::uint32_t i = leg; i < count; ++i) {
    route.fly_leg(i, start);
    const Transfer transfer = i + 1 < count ? plan.legs[i].transfer : Transfer::kEnd;
    if (lands_at_exit(transfer)) {
      route.go(ground_below(to_vec(plan.legs[i].exit), terrain), Phase::kLanding, i);
      return route.take();
    }
    if (transfer == Transfer::kFFDU) {
      route.land(to_vec(plan.legs[i + 1].entry), i + 1);
      return route.take();
    }
    if (i - leg >= kMaxLegsPerRoute) break;
  }
  return route.take();
}

Vec3 goal_way_start(const data::Goal& goal, const RouteStart& start, const Terrain& terrain,
                    const VehicleLimits& limits) {
  if (!start.on_ground) return start.position_m;
  const double ground_m = terrain.height_at(start.position_m.x(), start.position_m.y());
  const double height_m = std::max(goal.start.z_m, ground_m + 1.5 * limits.clearance_m());
  return {start.position_m.x(), start.position_m.y(), height_m};
}

std::vector<RoutePoint> goal_route(const data::Goal& goal, const RouteStart& start, const Terrain& terrain,
                                   const VehicleLimits& limits, const std::vector<Vec3>& corners,
                                   double hold_s) {
  std::vector<RoutePoint> route;
  if (start.on_ground)
    route.push_back({goal_way_start(goal, start, terrain, limits), Phase::kTakeOff, 0, 0.0});
  for (const Vec3& corner : corners) route.push_back({corner, Phase::kTransfer, 0, 0.0});
  route.push_back({to_vec(goal.position), Phase::kTransfer, 0, 0.0});
  route.push_back({to_vec(goal.position), Phase::kHold, 0, hold_s});
  return route;
}

}  // namespace swallowtail::planner
