#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/rng.hpp"
#include "planner/base/vec.hpp"
#include "planner/swarm/multi_problem.hpp"
#include "planner/swarm/problem.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::planner {

/// How navigation variables become a path.
enum class NavigationForm : std::uint8_t {
  kRepaired,   ///< every limit holds on every segment, the last one included, by repair (`nmopso`)
  kPublished,  ///< as the public reference code of [NMOPSO] (`nmopso-seed`)
};

struct NavigationSpec {
  struct Threat {
    Vec2 center_m = Vec2::Zero();
    double radius_m = 0.0;
  };

  Vec3 start_m = Vec3::Zero();  ///< above sea level
  Vec3 goal_m = Vec3::Zero();
  Vec2 box_min_m = Vec2::Zero();  ///< where nodes may be
  Vec2 box_max_m = Vec2::Zero();
  int nodes = 10;                             ///< between start and goal, 1 to 64
  double turn_max_rad = 0.7853981633974483;   ///< ψ_max, heading change at a node; (0, π/2)
  double climb_max_rad = 0.7853981633974483;  ///< θ_max, change of the climb angle and the angle itself
  std::optional<double> segment_min_m;        ///< R_min; default: a twentieth of start–goal per node share
  double height_min_m = 100.0;                ///< above ground
  double height_max_m = 200.0;
  std::vector<Threat> threats;
  double vehicle_size_m = 1.0;      ///< D
  double danger_distance_m = 10.0;  ///< S
  NavigationForm form = NavigationForm::kRepaired;
};

/// Paths by navigation variables and their four objectives [NMOPSO F1–F4], minimised:
/// F1 = 1 − ‖P_1 P_n‖/Σ‖P_j P_{j+1}‖, infinite if a segment is shorter than R_min;
/// F2 = mean over segments and threats of 0 | 1 − (d − D − R)/S | ∞, d the level distance of segment and
/// axis; F3 = mean over the nodes between start and goal of |h − mid|/(half the band), ∞ outside the band; F4
/// = mean over those nodes of |η|/π, η the angle between its two segments.
///
/// Variables: (r, θ, ψ) per segment: its length, the change of climb angle and of heading, chained: heading
/// β_j = β_{j−1} + ψ_j, climb α_j = α_{j−1} + θ_j, as the equations of motion of the source have it; β_0
/// points from start to goal, α_0 = 0.
///
/// kPublished: one triple for each node, heights of the chain count above ground, nodes are clamped to the
/// box; R_min, band and terrain are looked at as the source's code does: band at nodes only, and nothing
/// limits the angles at the last node. Departs from that code: F1 and F4 use true heights throughout.
///
/// kRepaired: one triple for each segment, the last one too. The chain is turned and scaled about the start
/// until it ends at the goal, which keeps all its angles; the heights' error is spread evenly along the way.
/// Then nodes are pushed out of threats, spread to R_min, and heights lifted or lowered until whole segments
/// keep the band. What still breaks a limit afterwards is infeasible, so that every feasible candidate keeps
/// on every segment: R_min, turn and change of climb at every node, climb of every segment, the turn of the
/// first segment away from start–goal, the band (exact between nodes), the box and the threats.
class NavigationProblem {
 public:
  static constexpr Eigen::Index kObjectives = 4;
  static constexpr int kMaxNodes = 64;

  /// Errors: no start or goal within the box, start or goal outside the band or in a threat, a limit out of
  /// range, an empty band, R_min so long that the segments do not fit.
  static Result<NavigationProblem> make(const Terrain& terrain, const NavigationSpec& spec);

  /// For swarm::run_multi; shares what it needs. Reference point (1, 1, 1, 1).
  swarm::MultiProblem problem() const;
  /// Σ weight · F as one objective. Shares what it needs.
  swarm::Problem weighted(const Eigen::Vector4d& weights) const;

  /// The path of a candidate, start and goal included.
  std::vector<Vec3> polyline(const Eigen::Ref<const Eigen::VectorXd>& candidate) const;
  /// F1–F4 of the candidate.
  Eigen::Vector4d objectives(const Eigen::Ref<const Eigen::VectorXd>& candidate) const;
  /// kRepaired: the candidate of a path with as many nodes, start and goal included, clamped to the limits.
  Eigen::VectorXd encode(std::span<const Vec3> polyline) const;
  /// kRepaired: (dimension × count) bowed paths that follow the ground more or less smoothly. May be
  /// infeasible.
  Eigen::MatrixXd guesses(int count, Rng& rng) const;

 private:
  struct Impl;
  explicit NavigationProblem(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

}  // namespace swallowtail::planner
