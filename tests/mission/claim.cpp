#include <algorithm>
#include <cmath>

#include "tests/mission/random_mission.hpp"

/// What a plan claims to have covered.
namespace swallowtail::mission {
namespace {

constexpr double kCell_m = 0.5;

bool under(const data::Leg& leg, double half_width_m, const Vec2& p) {
  const Vec2 entry(leg.entry.x_m, leg.entry.y_m);
  const Vec2 way = Vec2(leg.exit.x_m, leg.exit.y_m) - entry;
  const double length = way.norm();
  if (leg.kind != data::LegKind::kCover || length < 1e-9) return false;
  const Vec2 off = p - entry;
  const double along = off.dot(way) / length;
  const double across = (off.x() * way.y() - off.y() * way.x()) / length;
  return along >= 0.0 && along <= length && std::abs(across) <= half_width_m;
}

}  // namespace

/// Crossings of a ray to the east.
bool within(const coverage::Ring& ring, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    if ((ring[i].y() > p.y()) == (ring[j].y() > p.y())) continue;
    const double share = (p.y() - ring[i].y()) / (ring[j].y() - ring[i].y());
    if (p.x() < ring[i].x() + share * (ring[j].x() - ring[i].x())) inside = !inside;
  }
  return inside;
}

double claimed_percent(const RandomMission& mission, const data::CoveragePlan& plan, std::size_t legs_done) {
  const double half_width_m = 0.5 * mission.scenario.coverage->sensor_width_m;
  std::size_t inside = 0;
  std::size_t seen = 0;
  for (const coverage::Polygon& field : mission.fields) {
    Vec2 lo = field.outline.front();
    Vec2 hi = lo;
    for (const Vec2& corner : field.outline) {
      lo = lo.cwiseMin(corner);
      hi = hi.cwiseMax(corner);
    }
    for (double x = lo.x() + 0.5 * kCell_m; x < hi.x(); x += kCell_m) {
      for (double y = lo.y() + 0.5 * kCell_m; y < hi.y(); y += kCell_m) {
        const Vec2 p(x, y);
        if (!within(field.outline, p)) continue;
        if (std::any_of(field.holes.begin(), field.holes.end(),
                        [&](const coverage::Ring& hole) { return within(hole, p); }))
          continue;
        if (std::any_of(mission.no_fly.begin(), mission.no_fly.end(),
                        [&](const coverage::Polygon& area) { return within(area.outline, p); }))
          continue;
        ++inside;
        for (std::size_t i = 0; i < std::min(legs_done, plan.legs.size()); ++i) {
          if (!under(plan.legs[i], half_width_m, p)) continue;
          ++seen;
          break;
        }
      }
    }
  }
  return inside == 0 ? 0.0 : 100.0 * static_cast<double>(seen) / static_cast<double>(inside);
}

}  // namespace swallowtail::mission
