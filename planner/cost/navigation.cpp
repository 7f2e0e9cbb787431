#include "planner/cost/navigation.hpp"

#include <limits>
#include <sstream>

#include "planner/base/checks.hpp"
#include "planner/cost/navigation_path.hpp"

namespace swallowtail::planner {

using navigation::Path;
using navigation::Scene;

struct NavigationProblem::Impl {
  Scene scene;

  bool repaired() const { return scene.spec.form == NavigationForm::kRepaired; }
  Eigen::Index dimension() const { return 3 * (scene.spec.nodes + (repaired() ? 1 : 0)); }

  /// True if feasible, as far as the form looks.
  bool decode(const double* variables, Path& path) const {
    if (repaired()) return navigation::follow_chain(scene, variables, path) && repair(scene, path);
    navigation::follow_published_chain(scene, variables, path);
    return true;
  }

  Eigen::Vector4d objectives(const double* variables) const {
    Path path;
    if (!decode(variables, path)) {
      return Eigen::Vector4d::Constant(std::numeric_limits<double>::infinity());
    }
    return measure(scene, path);
  }

  void vary(const double* candidate, Rng& rng, Eigen::Ref<Eigen::VectorXd> neighbour) const {
    Path path;
    decode(candidate, path);
    shake(scene, path, rng);
    navigation::write_chain(scene, path.all(), neighbour.data());
  }

  void bounds(Eigen::VectorXd& lower, Eigen::VectorXd& upper) const {
    const Vec3 most(scene.segment_max_m, scene.spec.climb_max_rad, scene.spec.turn_max_rad);
    const Vec3 least(scene.segment_min_m, -most.y(), -most.z());
    lower = least.replicate(dimension() / 3, 1);
    upper = most.replicate(dimension() / 3, 1);
  }
};

namespace {

std::string text(const Vec3& p) {
  std::ostringstream out;
  out << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
  return out.str();
}

Status check_end(const Scene& scene, const Vec3& p, const std::string& name) {
  const NavigationSpec& spec = scene.spec;
  if (!is_finite(p)) return bad_input("The " + name + " is not finite.");
  const Vec2 at = p.head<2>();
  if ((at.array() < spec.box_min_m.array()).any() || (at.array() > spec.box_max_m.array()).any()) {
    return bad_input("The " + name + " " + text(p) + " lies outside the box.");
  }
  const double height_m = p.z() - scene.ground.height_at(p.x(), p.y());
  if (!is_within(height_m, spec.height_min_m, spec.height_max_m)) {
    return infeasible("The " + name + " " + text(p) + " is " + std::to_string(height_m) +
                      " m above ground; the band is " + std::to_string(spec.height_min_m) + " to " +
                      std::to_string(spec.height_max_m) + " m.");
  }
  for (const NavigationSpec::Threat& threat : spec.threats) {
    if ((at - threat.center_m).norm() > threat.radius_m + spec.vehicle_size_m) continue;
    return infeasible("The " + name + " " + text(p) + " lies in the threat at (" +
                      std::to_string(threat.center_m.x()) + ", " + std::to_string(threat.center_m.y()) +
                      ").");
  }
  return {};
}

Status check_numbers(const NavigationSpec& spec) {
  constexpr double kRightAngle = 0.5 * std::numbers::pi;
  if (spec.nodes < 1 || spec.nodes > NavigationProblem::kMaxNodes) {
    return bad_input("The number of nodes is " + std::to_string(spec.nodes) + "; it must be 1 to 64.");
  }
  if (!(spec.turn_max_rad > 0.0 && spec.turn_max_rad < kRightAngle) ||
      !(spec.climb_max_rad > 0.0 && spec.climb_max_rad < kRightAngle)) {
    return bad_input("Turn and climb limits must be between 0 and 90 degrees.");
  }
  if (!is_finite(spec.box_min_m) || !is_finite(spec.box_max_m) ||
      !(spec.box_min_m.array() < spec.box_max_m.array()).all()) {
    return bad_input("The box of the nodes is empty or not finite.");
  }
  if (!is_finite(spec.height_min_m) || !is_finite(spec.height_max_m) ||
      !(spec.height_min_m < spec.height_max_m)) {
    return bad_input("The band of heights above ground is empty or not finite.");
  }
  if (!is_non_negative(spec.vehicle_size_m) || !is_positive(spec.danger_distance_m)) {
    return bad_input("The vehicle's size must not be negative and the danger distance positive.");
  }
  for (const NavigationSpec::Threat& threat : spec.threats) {
    if (!is_finite(threat.center_m) || !is_non_negative(threat.radius_m)) {
      return bad_input("A threat's centre is not finite or its radius negative.");
    }
  }
  return {};
}

}  // namespace

Result<NavigationProblem> NavigationProblem::make(const Terrain& terrain, const NavigationSpec& spec) {
  if (Status status = check_numbers(spec); !status) return status.error();
  auto impl = std::make_shared<Impl>(Impl{Scene{spec, NavigationGround(terrain)}});
  Scene& scene = impl->scene;
  if (Status status = check_end(scene, spec.start_m, "start"); !status) return status.error();
  if (Status status = check_end(scene, spec.goal_m, "goal"); !status) return status.error();
  const Vec3 line = spec.goal_m - spec.start_m;
  if (!(line.head<2>().norm() > 1e-6)) return bad_input("Start and goal stand above each other.");
  scene.distance_m = line.norm();
  scene.bearing_rad = std::atan2(line.y(), line.x());
  scene.segment_min_m = spec.segment_min_m.value_or(scene.distance_m / (3.0 * spec.nodes));
  scene.segment_max_m = 3.0 * scene.distance_m / spec.nodes;
  scene.slope_max = std::tan(spec.climb_max_rad);
  if (!is_non_negative(scene.segment_min_m) || scene.segment_min_m >= scene.segment_max_m) {
    return bad_input("The shortest segment is " + std::to_string(scene.segment_min_m) +
                     " m; it must not be negative and less than the longest, " +
                     std::to_string(scene.segment_max_m) + " m.");
  }
  return NavigationProblem(std::move(impl));
}

swarm::MultiProblem NavigationProblem::problem() const {
  swarm::MultiProblem problem;
  impl_->bounds(problem.lower, problem.upper);
  problem.objectives = kObjectives;
  problem.reference = Eigen::Vector4d::Ones();
  problem.evaluate = [impl = impl_](swarm::Candidates candidates, swarm::Objectives values) {
    for (Eigen::Index i = 0; i < candidates.cols(); ++i) {
      values.col(i) = impl->objectives(candidates.col(i).data());
    }
  };
  if (!impl_->repaired()) return problem;
  problem.vary = [impl = impl_](const Eigen::Ref<const Eigen::VectorXd>& candidate, Rng& rng,
                                Eigen::Ref<Eigen::VectorXd> neighbour) {
    impl->vary(candidate.data(), rng, neighbour);
  };
  return problem;
}

swarm::Problem NavigationProblem::weighted(const Eigen::Vector4d& weights) const {
  swarm::Problem problem;
  impl_->bounds(problem.lower, problem.upper);
  problem.evaluate = [impl = impl_, weights](swarm::Candidates candidates, swarm::Costs costs) {
    for (Eigen::Index i = 0; i < candidates.cols(); ++i) {
      const Eigen::Vector4d values = impl->objectives(candidates.col(i).data());
      costs[i] = values.allFinite() ? weights.dot(values) : std::numeric_limits<double>::infinity();
    }
  };
  return problem;
}

std::vector<Vec3> NavigationProblem::polyline(const Eigen::Ref<const Eigen::VectorXd>& candidate) const {
  Path path;
  impl_->decode(candidate.data(), path);
  return {path.all().begin(), path.all().end()};
}

Eigen::Vector4d NavigationProblem::objectives(const Eigen::Ref<const Eigen::VectorXd>& candidate) const {
  return impl_->objectives(candidate.data());
}

Eigen::VectorXd NavigationProblem::encode(std::span<const Vec3> polyline) const {
  Eigen::VectorXd candidate(static_cast<Eigen::Index>(3 * (polyline.size() - 1)));
  navigation::write_chain(impl_->scene, polyline, candidate.data());
  return candidate;
}

Eigen::MatrixXd NavigationProblem::guesses(int count, Rng& rng) const {
  Eigen::MatrixXd guesses(impl_->dimension(), count);
  Path path;
  for (Eigen::Index i = 0; i < guesses.cols(); ++i) {
    bow(impl_->scene, path, rng);
    navigation::write_chain(impl_->scene, path.all(), guesses.col(i).data());
  }
  return guesses;
}

}  // namespace swallowtail::planner
