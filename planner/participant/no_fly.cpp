#include "planner/participant/no_fly.hpp"

#include <string>
#include <utility>

#include "planner/world/prisms.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kMaxWidth_m = 1e5;

std::vector<Vec2> points_of(const data::CoverageTask& task, const data::Ring& ring) {
  std::vector<Vec2> out;
  for (std::uint32_t i = 0; i < ring.point_count; ++i) {
    const data::Point2& p = task.points.at(ring.first_point + i);
    out.emplace_back(p.x_m, p.y_m);
  }
  return out;
}

bool is_wide(const std::vector<Vec2>& outline) {
  Vec2 lo = outline.front();
  Vec2 hi = lo;
  for (const Vec2& p : outline) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  return (hi - lo).maxCoeff() > kMaxWidth_m;
}

}  // namespace

std::vector<Area> areas_of(const data::CoverageTask& task, data::AreaKind kind) {
  std::vector<Area> areas;
  for (const data::Ring& ring : task.rings) {
    if (ring.kind != kind) continue;
    if (ring.area_index >= areas.size()) areas.resize(ring.area_index + 1);
    Area& area = areas[ring.area_index];
    if (ring.is_hole) {
      area.holes.push_back(points_of(task, ring));
    } else {
      area.outline = points_of(task, ring);
    }
  }
  return areas;
}

Result<std::vector<std::vector<Vec2>>> no_fly_parts(const data::CoverageTask& task) {
  std::vector<std::vector<Vec2>> out;
  const std::vector<Area> areas = areas_of(task, data::AreaKind::kNoFly);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const std::string name = "No-fly area " + std::to_string(i);
    if (is_wide(areas[i].outline)) return bad_input(name + " is wider than 100 km.");
    auto parts = convex_parts(areas[i]);
    if (!parts) return Error{parts.error().code, name + ": " + parts.error().message};
    for (std::vector<Vec2>& part : *parts) out.push_back(std::move(part));
    if (out.size() > kMaxNoFlyParts)
      return bad_input("The no-fly areas have more than " + std::to_string(kMaxNoFlyParts) +
                       " convex parts.");
  }
  return out;
}

}  // namespace swallowtail::planner
