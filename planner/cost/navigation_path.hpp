#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "planner/base/rng.hpp"
#include "planner/cost/navigation.hpp"
#include "planner/cost/navigation_ground.hpp"

/// The parts of NavigationProblem: from variables to a path, its repair, its objectives, its neighbours.
namespace swallowtail::planner::navigation {

/// Start, nodes and goal, with the ground under each.
struct Path {
  int points = 0;
  std::array<Vec3, NavigationProblem::kMaxNodes + 2> at;
  std::array<double, NavigationProblem::kMaxNodes + 2> ground_m{};

  int segments() const { return points - 1; }
  std::span<const Vec3> all() const { return {at.data(), static_cast<std::size_t>(points)}; }
};

/// A spec with what is derived from it once.
struct Scene {
  NavigationSpec spec;
  NavigationGround ground;
  double distance_m = 0.0;     ///< start to goal
  double bearing_rad = 0.0;    ///< of start–goal
  double segment_min_m = 0.0;  ///< R_min
  double segment_max_m = 0.0;  ///< R_max = 3 · start–goal/nodes, as the reference code
  double slope_max = 0.0;      ///< tan θ_max

  double middle_m() const { return 0.5 * (spec.height_min_m + spec.height_max_m); }
  double half_band_m() const { return 0.5 * (spec.height_max_m - spec.height_min_m); }
};

/// Distances are kept by this much more than asked, angles by this share less: rounding on the way through
/// the variables takes none of it back.
inline constexpr double kGuard_m = 1e-6;
inline constexpr double kGuardShare = 1e-9;

inline double wrapped(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

/// Variables to path, before any repair. False if the chain ends where it began.
bool follow_chain(const Scene& scene, const double* variables, Path& path);
/// kPublished.
void follow_published_chain(const Scene& scene, const double* variables, Path& path);
void write_chain(const Scene& scene, std::span<const Vec3> polyline, double* variables);

/// True if every limit of kRepaired holds afterwards. Takes no memory.
bool repair(const Scene& scene, Path& path);

/// F1–F4; all infinite where a segment is too short, a threat is met or a node leaves the band.
Eigen::Vector4d measure(const Scene& scene, const Path& path);

/// Changes nodes of a path a little; may break limits.
void shake(const Scene& scene, Path& path, Rng& rng);
/// A bowed path over the ground; may break limits.
void bow(const Scene& scene, Path& path, Rng& rng);

}  // namespace swallowtail::planner::navigation
