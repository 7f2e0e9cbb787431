#pragma once

#include <string>
#include <vector>

#include "planner/base/vec.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::bench {

struct ViewedPath {
  std::string name;
  std::vector<Vec3> points_m;
};

/// The world and paths through it in isometric projection from the south-west and above: the box, the ground
/// as a mesh of at most 40 × 40 lines, obstacles as their outlines (at most the 400 nearest to the first
/// path), paths on top. Colours as in `color_of`.
std::string draw_scene(const std::string& title, const planner::World& world,
                       const std::vector<ViewedPath>& paths);

}  // namespace swallowtail::bench
