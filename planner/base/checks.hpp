#pragma once

#include <cmath>

#include "planner/base/vec.hpp"

namespace swallowtail {

/// The small vocabulary of range checks used wherever input is validated. NaN fails every one of them.
inline bool is_finite(double v) { return std::isfinite(v); }
inline bool is_finite(const Vec2& v) { return v.allFinite(); }
inline bool is_finite(const Vec3& v) { return v.allFinite(); }
inline bool is_within(double v, double min, double max) { return v >= min && v <= max; }
inline bool is_positive(double v) { return std::isfinite(v) && v > 0.0; }
inline bool is_non_negative(double v) { return std::isfinite(v) && v >= 0.0; }

}  // namespace swallowtail
