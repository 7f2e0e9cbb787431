#include "planner/cost/path_problem.hpp"

#include <algorithm>

#include "planner/base/checks.hpp"
#include "planner/cost/path_batch.hpp"

namespace swallowtail::planner {
namespace {

/// One for each thread: evaluation takes no memory after the first call.
PathBatch& thread_batch() {
  thread_local PathBatch batch;
  return batch;
}

}  // namespace

struct PathProblem::Impl {
  std::shared_ptr<const CostScene> scene;
  PathProblemSpec spec;
  Encoding encoding;
  Preset preset;
  bool step_grows = false;
  double step = 0.0;

  double weight(const WeightedObjective& entry) const {
    const bool steps = step_grows && std::string_view(entry.objective->name()) == "collision";
    return steps ? step : entry.weight;
  }

  /// Calls visit(first column, columns, batch) for each eight columns; lanes without one repeat the last.
  template <class Visit>
  void for_batches(swarm::Candidates candidates, const Visit& visit) const {
    PathBatch& batch = thread_batch();
    batch.resize(static_cast<std::size_t>(encoding.waypoints()) + 2);
    for (Eigen::Index first = 0; first < candidates.cols(); first += kLanes) {
      const Eigen::Index columns = std::min<Eigen::Index>(kLanes, candidates.cols() - first);
      for (int lane = 0; lane < kLanes; ++lane) {
        const Eigen::Index column = first + std::min<Eigen::Index>(lane, columns - 1);
        encoding.place(candidates.data() + column * candidates.outerStride(), lane, batch);
      }
      batch.measure();
      visit(first, columns, batch);
    }
  }

  void evaluate(swarm::Candidates candidates, swarm::Costs costs) const {
    for_batches(candidates, [&](Eigen::Index first, Eigen::Index columns, const PathBatch& batch) {
      Lanes sum = Lanes::Zero();
      Lanes values;
      for (const WeightedObjective& entry : preset.objectives) {
        entry.objective->evaluate(batch, values);
        sum += weight(entry) * values;
      }
      costs.segment(first, columns) = sum.head(columns);
    });
  }
};

PathProblem::PathProblem(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {
  problem_.lower = impl_->encoding.lower();
  problem_.upper = impl_->encoding.upper();
  problem_.waypoints = impl_->encoding.layout();
  problem_.evaluate = [shared = impl_](swarm::Candidates candidates, swarm::Costs costs) {
    shared->evaluate(candidates, costs);
  };
  if (!impl_->step_grows) return;
  problem_.begin_iteration = [shared = impl_](std::uint64_t iteration) {
    const double before = shared->step;
    shared->step = std::max(1.0, static_cast<double>(iteration));
    return shared->step != before;
  };
}

PathProblem::~PathProblem() = default;
PathProblem::PathProblem(PathProblem&&) noexcept = default;
PathProblem& PathProblem::operator=(PathProblem&&) noexcept = default;

Result<PathProblem> PathProblem::make(std::shared_ptr<const World> world, const PathProblemSpec& spec) {
  if (world == nullptr) return bad_input("There is no world to plan in.");
  if (Status status = validate(spec.limits); !status) return status.error();
  if (!is_finite(spec.start_m) || !is_finite(spec.goal_m))
    return bad_input("The start or the goal is not finite.");
  if ((spec.goal_m - spec.start_m).norm() <= kSamePlace_m) {
    return bad_input("The start and the goal are one place; a path between them is no problem.");
  }
  return make(std::make_shared<const CostScene>(std::move(world), spec.limits, spec.start_m, spec.goal_m),
              spec);
}

Result<PathProblem> PathProblem::make(const std::shared_ptr<const CostScene>& scene,
                                      const PathProblemSpec& spec) {
  if (spec.waypoints < 1 || spec.waypoints > 64) {
    return bad_input("The number of waypoints is " + std::to_string(spec.waypoints) +
                     "; it must be 1 to 64.");
  }
  Result<Preset> preset = make_preset(spec.cost, scene, spec.waypoints);
  if (!preset) return preset.error();
  Result<Encoding> encoding =
      Encoding::make(spec.encoding.value_or(preset->encoding), scene, spec.waypoints, preset->altitude);
  if (!encoding) return encoding.error();
  const bool steps = spec.cost.step_grows && preset->name == "BOA";
  return PathProblem(std::make_shared<Impl>(
      Impl{scene, spec, std::move(*encoding), std::move(*preset), steps, spec.cost.step_end}));
}

Result<PathProblem> PathProblem::with_waypoints(int waypoints) const {
  PathProblemSpec spec = impl_->spec;
  spec.waypoints = waypoints;
  return make(impl_->scene, spec);
}

int PathProblem::waypoints() const { return impl_->encoding.waypoints(); }

const std::string& PathProblem::preset() const { return impl_->preset.name; }

std::vector<Vec3> PathProblem::decode(const Eigen::Ref<const Eigen::VectorXd>& candidate) const {
  std::vector<Vec3> points;
  for (int i = 0; i < waypoints(); ++i) points.push_back(impl_->encoding.waypoint(candidate.data(), i));
  return points;
}

Eigen::VectorXd PathProblem::encode(std::span<const Vec3> waypoints) const {
  return impl_->encoding.encode(waypoints);
}

std::vector<Vec3> PathProblem::polyline(const Eigen::Ref<const Eigen::VectorXd>& candidate) const {
  std::vector<Vec3> points = decode(candidate);
  points.insert(points.begin(), impl_->encoding.start_m());
  points.push_back(impl_->encoding.goal_m());
  return points;
}

CostTerms PathProblem::terms(std::span<const Vec3> polyline) const {
  CostTerms result;
  PathBatch& batch = thread_batch();
  batch.fill(polyline);
  Lanes values;
  for (const WeightedObjective& entry : impl_->preset.objectives) {
    entry.objective->evaluate(batch, values);
    result.terms.push_back({entry.objective->name(), entry.weight, values[0]});
    result.total += entry.weight * values[0];
  }
  return result;
}

std::vector<std::string> PathProblem::names() const {
  std::vector<std::string> names;
  for (const WeightedObjective& entry : impl_->preset.objectives) names.emplace_back(entry.objective->name());
  return names;
}

void PathProblem::values(swarm::Candidates candidates, Eigen::Ref<Eigen::MatrixXd> values) const {
  impl_->for_batches(candidates, [&](Eigen::Index first, Eigen::Index columns, const PathBatch& batch) {
    Lanes lanes;
    for (std::size_t term = 0; term < impl_->preset.objectives.size(); ++term) {
      impl_->preset.objectives[term].objective->evaluate(batch, lanes);
      values.row(static_cast<Eigen::Index>(term)).segment(first, columns) =
          lanes.head(columns).matrix().transpose();
    }
  });
}

}  // namespace swallowtail::planner
