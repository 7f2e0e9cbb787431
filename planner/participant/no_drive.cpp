#include "planner/participant/no_drive.hpp"

#include <algorithm>

namespace swallowtail::planner {
namespace {

struct Where {
  bool is_inside = false;
  bool is_near = false;
};

Where where(const std::vector<Vec2>& ring, const Vec2& p) {
  Where out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& a = ring[i];
    const Vec2& b = ring[(i + 1) % ring.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      out.is_inside = !out.is_inside;
    const Vec2 along = b - a;
    const double square = along.squaredNorm();
    const double share = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
    out.is_near = out.is_near || (a + share * along - p).norm() < kOffNoDrive_m;
  }
  return out;
}

}  // namespace

bool is_in_or_near(std::span<const Area> areas, const Vec2& place) {
  return std::ranges::any_of(areas, [&](const Area& area) {
    const Where outline = where(area.outline, place);
    if (outline.is_near) return true;
    if (!outline.is_inside) return false;
    return std::ranges::all_of(area.holes, [&](const std::vector<Vec2>& hole) {
      const Where in_hole = where(hole, place);
      return in_hole.is_near || !in_hole.is_inside;
    });
  });
}

}  // namespace swallowtail::planner
