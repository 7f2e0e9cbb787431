#pragma once

#include "idl/data/validate.hpp"

namespace swallowtail::data {

/// The geometry of a task's areas: every ring refers to points that exist, has at least 3 and an area, does
/// not touch or cross itself; every field, and every area of another kind counted from 0, has one outline,
/// before its holes. O(points²) of the longest ring, about 50 ms for one ring of 8192 points; no allocation.
Refusal check_rings(const CoverageTask& task);

}  // namespace swallowtail::data
