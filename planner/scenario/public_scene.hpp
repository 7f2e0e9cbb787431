#pragma once

#include <memory>
#include <string>

#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::planner {

/// A scene of another project's public code, with its world.
struct PublicScene {
  Scenario scenario;
  std::shared_ptr<const World> world;
};

/// Reads the plain text scenes that the public codes [SPSO], [NMOPSO] and document [PSO] are compared on: a
/// key and its numbers a line, `#` begins a comment. Two kinds:
/// - spheres: `box` (least and greatest x y z), `start`, `goal`, `waypoints`, `sphere` (x y z radius) any
/// number of
///   times, `name`. A point vehicle among spheres, in metres.
/// - elevation model: `dem` (a raster beside the file or one folder up), `start`, `goal` and `threat` (x y
/// radius) in
///   the code's own numbers, which are the raster's columns and rows counted from 1 at its first row,
///   `zlimits` above ground, `waypoints`, `angle_limit_deg`, `size` (columns rows, checked),
///   `negative_to_zero`, and `weights` (SPSO) or `rmin_rmax` (NMOPSO). As in those codes a cell counts as a
///   metre, so the raster here has cells of 1 m and rows that go with y; heights stay in metres. Threats are
///   cylinders through the whole height. The vehicle has radius 1 (their drone size) and the angle limit for
///   turn and climb.
/// Errors name file, line, value and rule: an unreadable file, one of more than 1 MB, an unknown or repeated
/// key, a wrong count of numbers, one that is not finite, and what World::make and read_terrain refuse.
Result<PublicScene> read_public_scene(const std::string& path);

}  // namespace swallowtail::planner
