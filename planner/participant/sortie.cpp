#include "planner/participant/sortie.hpp"

#include <algorithm>
#include <limits>

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

double distance_to_hop_m(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 hop = b - a;
  const double share =
      hop.squaredNorm() > 0.0 ? std::clamp((p - a).dot(hop) / hop.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + share * hop - p).norm();
}

std::vector<Vec3> way_to_leg(const data::CoveragePlan& plan, std::uint32_t i) {
  std::vector<Vec3> way;
  const data::Leg& leg = plan.legs[i];
  for (std::uint32_t k = 0; k < leg.bend_count; ++k) way.push_back(to_vec(plan.bends[leg.first_bend + k]));
  return way;
}

std::vector<Vec3> way_with_ends(const data::CoveragePlan& plan, std::uint32_t i) {
  std::vector<Vec3> way = way_to_leg(plan, i);
  if (i > 0) way.insert(way.begin(), to_vec(plan.legs[i - 1].exit));
  way.push_back(to_vec(plan.legs[i].entry));
  return way;
}

bool same_way(const data::Leg& a, const data::Leg& b) {
  return a.kind == b.kind && a.entry == b.entry && a.exit == b.exit && a.transfer == b.transfer;
}

bool same_bends(const data::CoveragePlan& a, const data::CoveragePlan& b, std::size_t leg) {
  const data::Leg& l = a.legs[leg];
  const data::Leg& m = b.legs[leg];
  return std::equal(a.bends.begin() + l.first_bend, a.bends.begin() + l.first_bend + l.bend_count,
                    b.bends.begin() + m.first_bend, b.bends.begin() + m.first_bend + m.bend_count);
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

  void land_at_exit(std::uint32_t leg) {
    const Vec3 exit = to_vec(plan_.legs[leg].exit);
    go(exit, Phase::kTransfer, leg);
    go(ground_below(exit, terrain_), Phase::kLanding, leg);
  }

  void land_at_entry(std::uint32_t leg, const RouteStart& start) {
    go_to_entry(leg, start);
    go(ground_below(to_vec(plan_.legs[leg].entry), terrain_), Phase::kLanding, leg);
  }

  /// To above the entry of leg i, where its way is at flying height.
  void go_to_entry(std::uint32_t i, const RouteStart& start) {
    const Vec3 entry = to_vec(plan_.legs[i].entry);
    std::vector<Vec3> way = way_to_leg(plan_, i);
    const bool under_way = i == start.leg && !start.on_ground;
    if (under_way) way = corners_ahead(way_with_ends(plan_, i), start.position_m);
    if (!way.empty()) {
      // At its altitude from end to end: it climbs first and descends last.
      const double height_m = way.front().z();
      const Vec3& from = route_.empty() ? start.position_m : route_.back().position_m;
      if (!under_way && from.z() < height_m) go({from.x(), from.y(), height_m}, Phase::kTransfer, i);
      for (const Vec3& bend : way) go(bend, Phase::kTransfer, i);
      if (entry.z() < height_m) go({entry.x(), entry.y(), height_m}, Phase::kTransfer, i);
    }
    go(entry, Phase::kTransfer, i);
  }

  void fly_leg(std::uint32_t i, const RouteStart& start) {
    const data::Leg& leg = plan_.legs[i];
    const Vec3 entry = to_vec(leg.entry);
    const Vec3 exit = to_vec(leg.exit);
    const Phase phase = leg.kind == data::LegKind::kCover ? Phase::kCover : Phase::kTransfer;
    if (i != start.leg || !start.leg_started) {
      go_to_entry(i, start);
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

std::vector<Vec3> corners_ahead(const std::vector<Vec3>& way, const Vec3& position_m) {
  std::size_t next = way.size();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double away_m = distance_to_hop_m(position_m, way[i - 1], way[i]);
    if (away_m > nearest_m) continue;
    nearest_m = away_m;
    next = i;
  }
  std::vector<Vec3> corners;
  for (std::size_t i = next; i + 1 < way.size(); ++i) corners.push_back(way[i]);
  return corners;
}

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
      route.land_at_exit(std::min(leg, count) - 1);
      return route.take();
    }
    if (before.transfer == Transfer::kFFDU) {
      route.land_at_entry(leg, start);
      return route.take();
    }
  }
  if (leg >= count) return route.take();
  if (start.on_ground) route.take_off(start.position_m, plan.legs[leg].entry.z_m, leg);
  if (sortie.hops_to_entry && leg == sortie.first_leg && !start.leg_started) {
    route.land_at_entry(leg, start);
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
      route.land_at_entry(i + 1, start);
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

bool same_ahead(const data::CoveragePlan& a, const data::CoveragePlan& b, std::uint32_t leg) {
  if (leg > 0 && (a.legs.size() < leg || b.legs.size() < leg || !same_way(a.legs[leg - 1], b.legs[leg - 1])))
    return false;
  for (std::size_t i = leg; i < std::max(a.legs.size(), b.legs.size()); ++i) {
    if (i >= a.legs.size() || i >= b.legs.size() || !same_way(a.legs[i], b.legs[i]) || !same_bends(a, b, i))
      return false;
    if (a.legs[i].transfer != data::Transfer::kFF) return (i + 1 < a.legs.size()) == (i + 1 < b.legs.size());
  }
  return true;
}

}  // namespace swallowtail::planner
