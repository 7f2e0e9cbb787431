#pragma once

#include <memory>
#include <optional>
#include <string>

#include "planner/scenario/scenario.hpp"
#include "planner/world/world.hpp"
#include "tools/cli/exit.hpp"

namespace swallowtail::cli {

/// A scenario and its world at t = 0.
struct Scene {
  planner::Scenario scenario;
  std::shared_ptr<const planner::World> world;
};

/// Reads and builds; prints everything that is wrong to standard error and gives nothing then. Bad input is
/// the only way to fail. A scene in `.txt` is one of a public code (scenario/public_scene.hpp).
std::optional<planner::Scenario> read_scenario_or_tell(const std::string& path);
std::optional<Scene> read_scene_or_tell(const std::string& path);

}  // namespace swallowtail::cli
