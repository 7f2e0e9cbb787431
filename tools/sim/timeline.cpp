#include "tools/sim/timeline.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <utility>
#include <variant>

#include "planner/scenario/timeline.hpp"

namespace swallowtail::sim {

using planner::Obstacle;

Result<Timeline> Timeline::make(const planner::Scenario& scenario, const planner::Terrain& terrain) {
  Timeline timeline(scenario, terrain);
  for (const Obstacle& obstacle : timeline.obstacles_) timeline.placements_[obstacle.id] = 1;
  if (Status built = timeline.rebuild(); !built) return built.error();
  return timeline;
}

Status Timeline::rebuild() {
  auto world = planner::World::make(terrain_, obstacles_, scenario_.bounds);
  if (!world) return world.error();
  world_ = std::move(world).value();
  return {};
}

std::uint32_t Timeline::revision(std::uint32_t obstacle_id) const {
  const auto placed = placements_.find(obstacle_id);
  return placed == placements_.end() ? 0 : placed->second;
}

void Timeline::happen(const planner::Event& event, Changes& changes) {
  if (const auto* loss = std::get_if<planner::BatteryLoss>(&event.what)) {
    changes.energy_lost += loss->energy;
    return;
  }
  if (const auto* other = std::get_if<planner::AircraftReplaced>(&event.what)) {
    changes.aircraft = *other;
    return;
  }
  if (const auto* gone = std::get_if<planner::ObstacleVanishes>(&event.what)) {
    const auto last = std::ranges::find(obstacles_, gone->id, &Obstacle::id);
    if (last != obstacles_.end()) changes.removed.push_back(*last);
  }
  planner::apply(event, obstacles_);
  std::uint32_t placed_id = 0;
  if (const auto* appears = std::get_if<planner::ObstacleAppears>(&event.what))
    placed_id = appears->obstacle.id;
  if (const auto* moves = std::get_if<planner::ObstacleMoves>(&event.what)) placed_id = moves->id;
  const auto placed = std::ranges::find(obstacles_, placed_id, &Obstacle::id);
  if (placed == obstacles_.end()) return;
  ++placements_[placed_id];
  changes.placed.push_back(*placed);
}

Changes Timeline::advance(double time_s) {
  Changes changes;
  for (; next_event_ < scenario_.events.size() && scenario_.events[next_event_].at_s <= time_s;
       ++next_event_) {
    happen(scenario_.events[next_event_], changes);
  }
  const auto is_over = [time_s](const Obstacle& obstacle) { return obstacle.valid_until_s < time_s; };
  std::ranges::copy_if(obstacles_, std::back_inserter(changes.removed), is_over);
  std::erase_if(obstacles_, is_over);
  if (changes.world_changed()) {
    // The reader has validated every obstacle and event, so the world can be built.
    if (Status built = rebuild(); !built)
      std::fprintf(stderr, "swallowtail-sim: %s\n", built.error().message.c_str());
  }
  return changes;
}

}  // namespace swallowtail::sim
