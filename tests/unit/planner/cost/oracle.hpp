#pragma once

#include <string>
#include <vector>

#include "planner/cost/path_problem.hpp"

namespace swallowtail::planner::test {

/// A scene that the oracle understands: spheres over a raster.
struct OracleScene {
  TerrainGrid ground;
  struct Ball {
    Vec3 center_m;
    double radius_m;
    double required_m;  ///< distance to keep
  };
  std::vector<Ball> balls;
  double clearance_m = 0.0;         ///< the vehicle's
  double ground_clearance_m = 0.0;  ///< height to keep
  double danger_m = 0.0;
  double band_min_m = 0.0;
  double band_max_m = 0.0;
};

/// The value of an objective of a preset, slowly and by other means: written from the documents, it shares no
/// code with planner/cost.
double oracle(const OracleScene& scene, const std::string& preset, const std::string& objective,
              const std::vector<Vec3>& path);

}  // namespace swallowtail::planner::test
