#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"
#include "planner/world/obstacle.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::planner {

struct Bounds {
  Vec3 min_m = Vec3(-1e6, -1e6, -1e3);
  Vec3 max_m = Vec3(1e6, 1e6, 2e4);
  bool contains(const Vec3& p) const {
    return (p.array() >= min_m.array()).all() && (p.array() <= max_m.array()).all();
  }
};

/// An immutable snapshot of everything a path must keep clear of. Shared as std::shared_ptr<const World>; an
/// update builds a new one.
class World {
 public:
  /// Errors: an obstacle that does not validate, two with one id, empty bounds.
  static Result<std::shared_ptr<const World>> make(Terrain terrain, std::vector<Obstacle> obstacles,
                                                   Bounds bounds, std::uint32_t terrain_revision = 0,
                                                   std::uint32_t obstacle_revision = 0);

  const Terrain& terrain() const { return terrain_; }
  std::span<const Obstacle> obstacles() const { return obstacles_; }
  const Bounds& bounds() const { return bounds_; }
  std::uint32_t terrain_revision() const { return terrain_revision_; }
  std::uint32_t obstacle_revision() const { return obstacle_revision_; }

 private:
  World(Terrain terrain, std::vector<Obstacle> obstacles, Bounds bounds, std::uint32_t terrain_revision,
        std::uint32_t obstacle_revision);

  Terrain terrain_;
  std::vector<Obstacle> obstacles_;
  Bounds bounds_;
  std::uint32_t terrain_revision_;
  std::uint32_t obstacle_revision_;
};

}  // namespace swallowtail::planner
