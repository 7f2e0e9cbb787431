#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/cost/encoding.hpp"
#include "planner/cost/preset.hpp"
#include "planner/path/path.hpp"
#include "planner/swarm/problem.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::planner {

struct PathProblemSpec {
  Vec3 start_m = Vec3::Zero();
  Vec3 goal_m = Vec3::Zero();
  int waypoints = 6;  ///< between start and goal, 1 to 64
  VehicleLimits limits;
  CostSpec cost;
  std::optional<EncodingKind> encoding;  ///< instead of the preset's own
};

/// The value of one objective on one path; `total` sums weight · value.
struct CostTerm {
  std::string name;
  double weight = 0.0;
  double value = 0.0;
};
struct CostTerms {
  double total = 0.0;
  std::vector<CostTerm> terms;
};

/// A path between two points as an optimisation problem: an encoding of its waypoints and a weighted sum of
/// objectives, both chosen by a preset's name (preset.hpp). Obstacles stand where they are at mission time 0;
/// one that is gone by then does not count. Evaluation is in batches of eight, takes no memory after a
/// thread's first and may be done by several threads at once; what one column costs does not depend on the
/// others.
///
/// [BOA Eq. 16] punishes collisions more with every iteration: Step. The default forms minimise the cost with
/// Step at its end (CostSpec::step_end), where it does not change any more and which `terms` reports. With
/// CostSpec::step_grows, for the as-published forms, the problem has a `begin_iteration` that sets Step to
/// the iteration's number: the driver calls it, and what is remembered is evaluated anew. Such a problem
/// carries the state of one run: no two runs at once.
class PathProblem {
 public:
  /// Errors: no world, limits that do not validate, ends that are not finite or one place, 1 to 64 waypoints,
  /// an unknown preset or objective, a weight that is negative or not finite, a box without room.
  static Result<PathProblem> make(std::shared_ptr<const World> world, const PathProblemSpec& spec);
  /// The same with another number of waypoints; shares the scene.
  Result<PathProblem> with_waypoints(int waypoints) const;
  ~PathProblem();
  PathProblem(PathProblem&&) noexcept;
  PathProblem& operator=(PathProblem&&) noexcept;

  /// For `swarm::run`; shares what it needs, so it may outlive this.
  const swarm::Problem& problem() const { return problem_; }
  int waypoints() const;
  const std::string& preset() const;

  /// Waypoints of a candidate, without the ends; and the nearest candidate to waypoints (as many as
  /// waypoints(), see `resample` in replan/detour_problem.hpp).
  std::vector<Vec3> decode(const Eigen::Ref<const Eigen::VectorXd>& candidate) const;
  Eigen::VectorXd encode(std::span<const Vec3> waypoints) const;
  /// A candidate's path with both ends.
  std::vector<Vec3> polyline(const Eigen::Ref<const Eigen::VectorXd>& candidate) const;

  /// Of any polyline of 2 to 66 points, ends included: what `problem` minimises, term by term.
  CostTerms terms(std::span<const Vec3> polyline) const;
  /// Names in the order of `terms` and of the rows of `values`.
  std::vector<std::string> names() const;
  /// The objectives one by one, unweighted: values(term, column).
  void values(swarm::Candidates candidates, Eigen::Ref<Eigen::MatrixXd> values) const;

 private:
  struct Impl;
  static Result<PathProblem> make(const std::shared_ptr<const CostScene>& scene, const PathProblemSpec& spec);
  explicit PathProblem(std::shared_ptr<Impl> impl);

  std::shared_ptr<Impl> impl_;
  swarm::Problem problem_;
};

}  // namespace swallowtail::planner
