#include "tools/bench/plan/bench_case.hpp"

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "planner/scenario/load.hpp"
#include "planner/scenario/read.hpp"
#include "tools/bench/plan/scene_families.hpp"

namespace swallowtail::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBigWorld = "big_world";
constexpr std::uint64_t kBigWorldSeed = 1;

planner::VehicleLimits opened(planner::VehicleLimits limits) {
  limits.climb_max_rad = std::numbers::pi / 2.0;
  limits.turn_max_rad = std::numbers::pi;
  return limits;
}

Result<PlanCase> case_of(const planner::Scenario& scenario, const std::string& name) {
  if (!scenario.start_m || !scenario.goal_m)
    return bad_input(scenario.file + ": must have start_m and goal_m to be planned.");
  auto world = planner::load_world(scenario);
  if (!world) return world.error();
  return PlanCase{name,
                  *world,
                  *scenario.start_m,
                  *scenario.goal_m,
                  opened(scenario.vehicle.limits),
                  scenario.planning.waypoints};
}

}  // namespace

Result<PlanCase> load_case(const std::string& path) {
  const planner::ScenarioResult scenario = planner::read_scenario(path);
  if (!scenario.ok()) return bad_input(scenario.errors().text());
  return case_of(scenario.value(), fs::path(path).stem().string());
}

std::vector<std::string> default_cases(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "plan", error)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  names.emplace_back(kBigWorld);
  return names;
}

Result<PlanCase> case_by_name(const std::string& name, const std::string& folder) {
  if (name == kBigWorld) return big_world(kBigWorldSeed);
  const fs::path shipped = fs::path(folder) / "plan" / (name + ".yaml");
  std::error_code error;
  if (fs::exists(shipped, error)) return load_case(shipped.string());
  return load_case(name);
}

}  // namespace swallowtail::bench
