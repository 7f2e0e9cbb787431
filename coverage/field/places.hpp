#pragma once

#include <optional>
#include <span>
#include <string>

#include "coverage/field/polygon.hpp"
#include "coverage/field/sub_cells.hpp"

namespace swallowtail::coverage {

/// What must not be flown over at a place, for messages: "no-fly area 0", "a hole of field 'nl-3'" (unless
/// another field lies there); nothing where it is free, or less than 1 cm inside.
std::optional<std::string> barred_at(std::span<const Field> fields, std::span<const Polygon> no_fly,
                                     const Vec2& place_m);

}  // namespace swallowtail::coverage
