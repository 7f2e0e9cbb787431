#pragma once

#include "planner/base/vec.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::planner {

/// Where a straight flight is lowest above the ground.
struct GroundContact {
  double height_m = 0.0;      ///< centre line − ground
  double fraction = 0.0;      ///< along a–b
  Vec2 slope = Vec2::Zero();  ///< of the ground there, east and north
};

/// The lowest point above the ground of the part [from, to] (shares) of the segment a–b: exact, cell by cell
/// of the raster. Terrain::min_height_above tells the height alone and leaves out cells that cannot matter;
/// this tells where and which way the ground falls as well, which is what a descent needs.
GroundContact lowest_over(const Terrain& terrain, const Vec3& a, const Vec3& b, double from, double to);

/// A height above the ground at which the certifier's rule for the terrain holds around p (certifier.hpp: by
/// the steepest slope, or by the highest ground, within the clearance of p).
double height_to_keep_m(const Terrain& terrain, const Vec2& p, double clearance_m);

}  // namespace swallowtail::planner
