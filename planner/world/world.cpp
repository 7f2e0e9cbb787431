#include "planner/world/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "planner/base/checks.hpp"

namespace swallowtail::planner {

Result<std::shared_ptr<const World>> World::make(Terrain terrain, std::vector<Obstacle> obstacles,
                                                 Bounds bounds, std::uint32_t terrain_revision,
                                                 std::uint32_t obstacle_revision) {
  if (!is_finite(bounds.min_m) || !is_finite(bounds.max_m) ||
      !(bounds.min_m.array() < bounds.max_m.array()).all()) {
    return bad_input(fmt::format("The world's bounds ({}, {}, {}) … ({}, {}, {}) are empty or not finite.",
                                 bounds.min_m.x(), bounds.min_m.y(), bounds.min_m.z(), bounds.max_m.x(),
                                 bounds.max_m.y(), bounds.max_m.z()));
  }
  if (terrain.is_flat() && !is_finite(terrain.flat_elevation_m()))
    return bad_input("The flat terrain's elevation is not finite.");
  std::vector<std::uint32_t> ids;
  ids.reserve(obstacles.size());
  for (const Obstacle& obstacle : obstacles) {
    if (Status status = validate(obstacle); !status) return status.error();
    ids.push_back(obstacle.id);
  }
  std::sort(ids.begin(), ids.end());
  if (const auto twin = std::adjacent_find(ids.begin(), ids.end()); twin != ids.end()) {
    return bad_input(fmt::format("Two obstacles have the id {}; ids must differ.", *twin));
  }
  return std::shared_ptr<const World>(
      new World(std::move(terrain), std::move(obstacles), bounds, terrain_revision, obstacle_revision));
}

World::World(Terrain terrain, std::vector<Obstacle> obstacles, Bounds bounds, std::uint32_t terrain_revision,
             std::uint32_t obstacle_revision)
    : terrain_(std::move(terrain)),
      obstacles_(std::move(obstacles)),
      bounds_(bounds),
      terrain_revision_(terrain_revision),
      obstacle_revision_(obstacle_revision) {}

}  // namespace swallowtail::planner
