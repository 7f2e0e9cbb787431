#include "coverage/field/swath.hpp"

#include <algorithm>

#include "coverage/field/detail/geos.hpp"
#include "coverage/field/detail/patch.hpp"

namespace swallowtail::coverage {

namespace {

/// Swaths lie end to end and side by side at the slant of their lines: sides that should coincide all but do.
constexpr auto kVertices = detail::Shape::Vertices::kOnGrid;

detail::Shape swaths_of(std::span<const SubCell> sub_cells) {
  std::vector<Ring> swaths;
  for (const SubCell& sub_cell : sub_cells) {
    if (sub_cell.length_m() > 1e-6) swaths.push_back(swath_of(sub_cell));
  }
  return detail::Shape::of(swaths, kVertices);
}

}  // namespace

Ring swath_of(const SubCell& sub_cell) {
  const Vec2 a = sub_cell.alpha_m.head<2>();
  const Vec2 b = sub_cell.beta_m.head<2>();
  const double length = (b - a).norm();
  const Vec2 along = length > 0.0 ? Vec2((b - a) / length) : Vec2(1.0, 0.0);
  const Vec2 side = Vec2(-along.y(), along.x()) * (sub_cell.width_m / 2.0);
  return {a - side, b - side, b + side, a + side};
}

Result<SwathArea> swath_area(std::span<const Polygon> polygons, std::span<const SubCell> sub_cells) {
  const detail::Shape all = swaths_of(sub_cells);
  const detail::Shape inside = all.within(detail::Shape::of(polygons), kVertices);
  if (!inside.ok()) return internal_error("GEOS failed to unite the swaths of a field.");
  const double covered = inside.area_m2();
  return SwathArea{covered, std::max(0.0, all.area_m2() - covered)};
}

std::optional<Gap> largest_gap(std::span<const Polygon> polygons, std::span<const SubCell> sub_cells) {
  const detail::Shape open = detail::Shape::of(polygons).minus(swaths_of(sub_cells), kVertices);
  if (!open.ok()) return std::nullopt;
  std::optional<Gap> out;
  for (const Polygon& part : open.parts()) {
    const double part_m2 = area_m2(part);
    if (out && part_m2 <= out->area_m2) continue;
    const std::vector<detail::Patch> patches = detail::patches_of(part);
    const auto widest = std::max_element(
        patches.begin(), patches.end(),
        [](const detail::Patch& a, const detail::Patch& b) { return a.area_m2 < b.area_m2; });
    if (widest != patches.end()) out = Gap{part_m2, widest->middle_m};
  }
  return out;
}

}  // namespace swallowtail::coverage
