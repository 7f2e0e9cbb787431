#pragma once

#include <cstddef>

#include "planner/kernels/detail/field_solid.hpp"

/// The shapes' own numbers, by which the kernels choose their formulas (signed_distance.inl).
namespace swallowtail::planner::detail {

struct CylinderShape {
  double radius_m;
  double height_m;
};
struct ConeShape {
  double radius_m;
  double height_m;
  double slant_m;
};
struct BoxShape {
  double half_m[3];
};
struct MeshShape {
  const double* directions;  ///< three numbers each
  const double* supports;
  std::size_t count;
};

inline CylinderShape cylinder_of(const FieldSolid& s) { return {s.radius_m, s.height_m}; }
inline ConeShape cone_of(const FieldSolid& s) { return {s.radius_m, s.height_m, s.slant_m}; }
inline BoxShape box_of(const FieldSolid& s) { return {{s.half_m.x(), s.half_m.y(), s.half_m.z()}}; }
inline MeshShape mesh_of(const FieldSolid& s, const double* supports) {
  const double* first = supports + s.first_support;
  return {s.has_directions ? first + s.half_spaces : mesh_directions().front().data(), first, s.half_spaces};
}

/// Distances are found to this share of (hop length + bounding radius).
inline constexpr double kDistanceTolerance = 1e-11;

}  // namespace swallowtail::planner::detail
