#include "coverage/field/places.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::coverage {
namespace {

constexpr double kTouch_m = 0.01;

bool is_well_within(const Ring& ring, const Vec2& place_m) {
  return ring.size() >= 3 && contains(ring, place_m) && border_distance_m({ring, {}}, place_m) > kTouch_m;
}

}  // namespace

std::optional<std::string> barred_at(std::span<const Field> fields, std::span<const Polygon> no_fly,
                                     const Vec2& place_m) {
  for (std::size_t i = 0; i < no_fly.size(); ++i) {
    const bool in_hole = std::any_of(no_fly[i].holes.begin(), no_fly[i].holes.end(),
                                     [&](const Ring& hole) { return contains(hole, place_m); });
    if (!in_hole && is_well_within(no_fly[i].outline, place_m)) return "no-fly area " + std::to_string(i);
  }
  const bool on_field = std::any_of(fields.begin(), fields.end(), [&](const Field& field) {
    return field.polygon.outline.size() >= 3 && contains(field.polygon, place_m);
  });
  if (on_field) return std::nullopt;
  for (const Field& field : fields) {
    for (const Ring& hole : field.polygon.holes) {
      if (is_well_within(hole, place_m)) return "a hole of field '" + field.name + "'";
    }
  }
  return std::nullopt;
}

}  // namespace swallowtail::coverage
