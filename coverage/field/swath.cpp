#include "coverage/field/swath.hpp"

#include <algorithm>

#include "coverage/field/detail/geos.hpp"

namespace swallowtail::coverage {

Ring swath_of(const SubCell& sub_cell) {
  const Vec2 a = sub_cell.alpha_m.head<2>();
  const Vec2 b = sub_cell.beta_m.head<2>();
  const double length = (b - a).norm();
  const Vec2 along = length > 0.0 ? Vec2((b - a) / length) : Vec2(1.0, 0.0);
  const Vec2 side = Vec2(-along.y(), along.x()) * (sub_cell.width_m / 2.0);
  return {a - side, b - side, b + side, a + side};
}

Result<SwathArea> swath_area(std::span<const Polygon> polygons, std::span<const SubCell> sub_cells) {
  std::vector<Ring> swaths;
  for (const SubCell& sub_cell : sub_cells) {
    if (sub_cell.length_m() > 1e-6) swaths.push_back(swath_of(sub_cell));
  }
  const detail::Shape all = detail::Shape::of(swaths);
  const detail::Shape inside = all.within(detail::Shape::of(polygons));
  if (!inside.ok()) return internal_error("GEOS failed to unite the swaths of a field.");
  const double covered = inside.area_m2();
  return SwathArea{covered, std::max(0.0, all.area_m2() - covered)};
}

}  // namespace swallowtail::coverage
