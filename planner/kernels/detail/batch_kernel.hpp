#pragma once

#include <cstddef>
#include <span>

#include "planner/kernels/batch_field.hpp"
#include "planner/kernels/detail/field_solid.hpp"
#include "planner/kernels/detail/ground_view.hpp"

namespace swallowtail::planner::detail {

/// The obstacles that a kernel runs over, and the tree over them (of balls that stand still).
struct SolidList {
  const FieldSolid* solids;
  std::span<const BallNode> nodes;
  const double* supports;
};

/// Of a terrain that is no plane, and lives longer.
GroundView ground_view(const Terrain& terrain);

/// The loops of BatchField, compiled for one kind of processor.
struct BatchKernel {
  const char* name;
  void (*add_violation)(const SolidList&, const LanePoint&, const LanePoint&, Lanes& sum_m);
  std::size_t (*distances)(const SolidList&, const LanePoint&, const LanePoint&, double cap_m, LaneDistance*);
  void (*axis_distance)(const FieldSolid&, const LanePoint&, const LanePoint&, Lanes& out_m);
  /// The lesser of cap_m and each hop's least height above the raster; answers the lanes (bits) for which it
  /// was found: not those that leave the raster or cross very many blocks.
  unsigned (*least_height)(const GroundView&, const LanePoint&, const LanePoint&, double cap_m,
                           Lanes& least_m);
  /// The same for the length of each hop that lies at or below the raster.
  unsigned (*length_below)(const GroundView&, const LanePoint&, const LanePoint&, Lanes& length_m);
  void (*add_length)(const LanePoint&, const LanePoint&, Lanes& sum_m);
};

/// Those that this machine can run, the widest last. All give the same bits.
std::span<const BatchKernel> batch_kernels();

}  // namespace swallowtail::planner::detail
