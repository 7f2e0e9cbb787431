#pragma once

#include "tools/mission/check/rules.hpp"

namespace swallowtail::check {

/// Even-odd rule over all rings.
bool holds(const Rings& rings, const P2& p);
/// To the nearest point of any ring, from either side.
double border_distance_m(const Rings& rings, const P2& p);
double line_distance_m(const std::vector<P2>& line, const P2& p);

}  // namespace swallowtail::check
