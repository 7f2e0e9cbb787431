#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::sim {

/// What one call of Timeline::advance changed.
struct Changes {
  std::vector<planner::Obstacle> placed;   ///< new or restated
  std::vector<planner::Obstacle> removed;  ///< as they were last
  double energy_lost = 0.0;
  std::optional<planner::AircraftReplaced> aircraft{};  ///< that takes over

  bool world_changed() const { return !placed.empty() || !removed.empty(); }
};

/// The true world over time: the scenario's obstacles and events. Delays of the charger are not its business.
class Timeline {
 public:
  static Result<Timeline> make(const planner::Scenario& scenario, const planner::Terrain& terrain);

  /// Everything that happens up to and including `time_s` and has not happened yet. An obstacle whose time is
  /// over is removed.
  Changes advance(double time_s);

  const std::shared_ptr<const planner::World>& world() const { return world_; }
  const std::vector<planner::Obstacle>& obstacles() const { return obstacles_; }
  /// How often this obstacle has been placed; 1 for one known from the start.
  std::uint32_t revision(std::uint32_t obstacle_id) const;
  std::size_t events_left() const { return scenario_.events.size() - next_event_; }

 private:
  Timeline(const planner::Scenario& scenario, const planner::Terrain& terrain)
      : scenario_(scenario), terrain_(terrain), obstacles_(scenario.obstacles) {}

  void happen(const planner::Event& event, Changes& changes);
  Status rebuild();

  planner::Scenario scenario_;
  planner::Terrain terrain_;
  std::vector<planner::Obstacle> obstacles_;
  std::map<std::uint32_t, std::uint32_t> placements_;
  std::shared_ptr<const planner::World> world_;
  std::size_t next_event_ = 0;
};

}  // namespace swallowtail::sim
