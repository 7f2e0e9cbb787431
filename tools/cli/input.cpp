#include "tools/cli/input.hpp"

#include <utility>

#include <fmt/core.h>

#include "planner/scenario/load.hpp"
#include "planner/scenario/public_scene.hpp"
#include "planner/scenario/read.hpp"

namespace swallowtail::cli {

std::optional<planner::Scenario> read_scenario_or_tell(const std::string& path) {
  planner::ScenarioResult result = planner::read_scenario(path);
  if (result.ok()) return std::move(result).value();
  fmt::print(stderr, "{}", result.errors().text());
  return std::nullopt;
}

std::optional<Scene> read_scene_or_tell(const std::string& path) {
  if (path.ends_with(".txt")) {
    auto scene = planner::read_public_scene(path);
    if (scene) return Scene{std::move(scene->scenario), std::move(scene->world)};
    fmt::print(stderr, "{}\n", scene.error().message);
    return std::nullopt;
  }
  auto scenario = read_scenario_or_tell(path);
  if (!scenario) return std::nullopt;
  auto world = planner::load_world(*scenario);
  if (!world) {
    fmt::print(stderr, "{}: {}\n", path, world.error().message);
    return std::nullopt;
  }
  return Scene{std::move(*scenario), std::move(*world)};
}

}  // namespace swallowtail::cli
