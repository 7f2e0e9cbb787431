#include "tools/bench/plan/peer_ompl.hpp"

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "tools/bench/plan/judge.hpp"

namespace swallowtail::bench {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Space = ob::RealVectorStateSpace;

Vec3 place_of(const ob::State* state) {
  const double* v = state->as<Space::StateType>()->values;
  return {v[0], v[1], v[2]};
}

/// OMPL seeds all its random numbers from one place.
std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

void seed_all(std::uint64_t seed) {
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(seed));
}

/// Whole segments by the judge; counts what it was asked.
class ExactMotions final : public ob::MotionValidator {
 public:
  ExactMotions(const ob::SpaceInformationPtr& si, const Judge& judge)
      : ob::MotionValidator(si), judge_(judge) {}

  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    const bool free = judge_.free(place_of(a), place_of(b));
    ++(free ? valid_ : invalid_);
    return free;
  }
  /// How far along the motion is still valid, is asked for by planners that extend into obstacles; none here
  /// does, and "not at all" is a right answer.
  bool checkMotion(const ob::State* a, const ob::State* b,
                   std::pair<ob::State*, double>& last) const override {
    const bool free = checkMotion(a, b);
    if (!free) {
      last.second = 0.0;
      if (last.first != nullptr) si_->copyState(last.first, a);
    }
    return free;
  }

 private:
  const Judge& judge_;
};

std::vector<Vec3> polyline_of(const og::PathGeometric& path) {
  std::vector<Vec3> points;
  for (unsigned i = 0; i < path.getStateCount(); ++i) points.push_back(place_of(path.getState(i)));
  return points;
}

/// One problem of OMPL, ready to be solved.
struct Setup {
  explicit Setup(const PlanCase& plan_case) : judge(plan_case) {
    const auto space = std::make_shared<Space>(3);
    ob::RealVectorBounds box(3);
    for (unsigned i = 0; i < 3; ++i) {
      box.setLow(i, plan_case.world->bounds().min_m[i]);
      box.setHigh(i, plan_case.world->bounds().max_m[i]);
    }
    space->setBounds(box);
    si = std::make_shared<ob::SpaceInformation>(space);
    si->setStateValidityChecker([this](const ob::State* s) { return judge.free(place_of(s), place_of(s)); });
    auto motions = std::make_shared<ExactMotions>(si, judge);
    validator = motions.get();
    si->setMotionValidator(std::move(motions));
    si->setup();
    ob::ScopedState<Space> start(space);
    ob::ScopedState<Space> goal(space);
    for (unsigned i = 0; i < 3; ++i) {
      start[i] = plan_case.start_m[i];
      goal[i] = plan_case.goal_m[i];
    }
    problem = std::make_shared<ob::ProblemDefinition>(si);
    problem->setStartAndGoalStates(start, goal);
    problem->setOptimizationObjective(std::make_shared<ob::PathLengthOptimizationObjective>(si));
  }

  std::uint64_t checks() const { return validator->getCheckedMotionCount(); }
  bool is_over(const Recorder& recorder, const RunLimit& limit) const {
    return recorder.cpu_ms() >= 1e3 * limit.cpu_s || checks() >= limit.evaluations;
  }

  Judge judge;
  ob::SpaceInformationPtr si;
  const ExactMotions* validator = nullptr;
  ob::ProblemDefinitionPtr problem;
};

/// From start to goal through `inner`, which may hold the ends already.
std::vector<Vec3> with_ends(std::vector<Vec3> inner, const PlanCase& plan_case) {
  const auto at = [](const Vec3& a, const Vec3& b) { return (a - b).norm() < 1e-9; };
  if (inner.empty() || !at(inner.front(), plan_case.start_m)) inner.insert(inner.begin(), plan_case.start_m);
  if (!at(inner.back(), plan_case.goal_m)) inner.push_back(plan_case.goal_m);
  return inner;
}

/// States of an intermediate solution come from goal to start or the other way round, with or without ends,
/// by planner: the shorter reading is the path.
std::vector<Vec3> polyline_of(const std::vector<const ob::State*>& states, const PlanCase& plan_case) {
  std::vector<Vec3> points;
  for (const ob::State* state : states) points.push_back(place_of(state));
  std::vector<Vec3> forwards = with_ends(points, plan_case);
  std::ranges::reverse(points);
  std::vector<Vec3> backwards = with_ends(std::move(points), plan_case);
  return length_of(backwards) < length_of(forwards) ? backwards : forwards;
}

void offer_solution(const Setup& setup, Recorder& recorder) {
  const auto* path =
      setup.problem->hasExactSolution() ? setup.problem->getSolutionPath()->as<og::PathGeometric>() : nullptr;
  if (path == nullptr) return;
  const std::vector<Vec3> points = polyline_of(*path);
  recorder.offer(points, length_of(points), setup.checks(), 0);
}

template <class Planner>
PlanRun run_anytime(const PlanCase& plan_case, std::uint64_t seed, const RunLimit& limit) {
  const std::lock_guard lock(one_at_a_time());
  seed_all(seed);
  Recorder recorder;
  Setup setup(plan_case);
  const auto planner = std::make_shared<Planner>(setup.si);
  setup.problem->setIntermediateSolutionCallback(
      [&](const ob::Planner*, const std::vector<const ob::State*>& states, const ob::Cost) {
        const std::vector<Vec3> points = polyline_of(states, plan_case);
        recorder.offer(points, length_of(points), setup.checks(), 0);
      });
  planner->setProblemDefinition(setup.problem);
  planner->setup();
  planner->solve(ob::PlannerTerminationCondition([&] { return setup.is_over(recorder, limit); }));
  offer_solution(setup, recorder);
  return recorder.finish(setup.checks());
}

PlanRun run_connect(const PlanCase& plan_case, std::uint64_t seed, const RunLimit& limit) {
  const std::lock_guard lock(one_at_a_time());
  seed_all(seed);
  Recorder recorder;
  Setup setup(plan_case);
  const auto planner = std::make_shared<og::RRTConnect>(setup.si);
  planner->setProblemDefinition(setup.problem);
  planner->setup();
  planner->solve(ob::PlannerTerminationCondition([&] { return setup.is_over(recorder, limit); }));
  offer_solution(setup, recorder);
  if (setup.problem->hasExactSolution()) {
    auto* path = setup.problem->getSolutionPath()->as<og::PathGeometric>();
    og::PathSimplifier(setup.si).simplify(
        *path, ob::PlannerTerminationCondition([&] { return setup.is_over(recorder, limit); }));
    offer_solution(setup, recorder);
  }
  return recorder.finish(setup.checks());
}

}  // namespace

std::vector<Subject> ompl_subjects() {
  return {{"ompl RRTConnect+simplify", "ompl", run_connect},
          {"ompl RRT*", "ompl", run_anytime<og::RRTstar>},
          {"ompl InformedRRT*", "ompl", run_anytime<og::InformedRRTstar>},
          {"ompl BIT*", "ompl", run_anytime<og::BITstar>},
          {"ompl ABIT*", "ompl", run_anytime<og::ABITstar>}};
}

}  // namespace swallowtail::bench
