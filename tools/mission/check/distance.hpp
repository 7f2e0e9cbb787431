#pragma once

#include "tools/mission/check/rules.hpp"

namespace swallowtail::check {

/// Distance from a point to a solid at a mission time, 0 inside it.
double distance_m(const Solid& solid, const P3& point, double time_s);

}  // namespace swallowtail::check
