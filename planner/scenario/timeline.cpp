#include "planner/scenario/timeline.hpp"

#include <algorithm>

namespace swallowtail::planner {

void apply(const Event& event, std::vector<Obstacle>& obstacles) {
  const auto find = [&obstacles](std::uint32_t id) {
    return std::ranges::find(obstacles, id, &Obstacle::id);
  };
  if (const auto* appears = std::get_if<ObstacleAppears>(&event.what)) {
    obstacles.push_back(appears->obstacle);
  } else if (const auto* moves = std::get_if<ObstacleMoves>(&event.what)) {
    if (const auto it = find(moves->id); it != obstacles.end()) {
      it->position_m = it->position_at(event.at_s);
      it->state_time_s = event.at_s;
      it->velocity_mps = moves->velocity_mps;
    }
  } else if (const auto* vanishes = std::get_if<ObstacleVanishes>(&event.what)) {
    if (const auto it = find(vanishes->id); it != obstacles.end()) obstacles.erase(it);
  }
}

std::vector<Obstacle> obstacles_at(const Scenario& scenario, double time_s) {
  std::vector<Obstacle> obstacles = scenario.obstacles;
  for (const Event& event : scenario.events) {
    if (event.at_s > time_s) break;
    apply(event, obstacles);
  }
  return obstacles;
}

}  // namespace swallowtail::planner
