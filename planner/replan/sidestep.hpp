#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/base/rng.hpp"
#include "planner/kernels/obstacle_field.hpp"
#include "planner/replan/nearby_solids.hpp"

namespace swallowtail::planner {

/// Finds a way at once: flies straight, and where that hits something goes round it, over it or under it by
/// the side that costs least, and so on for the two parts, with a step back where a side leads nowhere. A
/// depth-first tree of tangents: no grid, no samples, so its first answer comes after a few looks at the
/// world. Where the tree grows too large, the way is halved at a free point near its middle; where that does
/// not help, it goes over everything. With `noise` the sides are tried in another order each time, which
/// leads to other corridors. What moves is met where it is at `start_time_s` plus the time to get there along
/// the way so far. It may find nothing where there is something.
class Sidestep {
 public:
  /// Borrows the field and its index.
  Sidestep(const ObstacleField& field, NearbySolids& nearby, const VehicleLimits& limits);

  /// A chain from `from` to `to`, ends included, straightened where it can be; empty if none was found within
  /// `max_looks` hops looked at.
  void find(const Vec3& from, const Vec3& to, double start_time_s, double noise, Rng& rng,
            std::uint64_t max_looks, std::vector<Vec3>& chain);
  std::uint64_t looks() const { return looks_; }

  /// Nothing comes too near to the hop.
  bool clear(const Vec3& a, const Vec3& b, double time_s);
  /// Leaves out what is not needed.
  void straighten(std::vector<Vec3>& chain, double start_time_s);

 private:
  static constexpr int kGround = -1;
  static constexpr int kSides = 8;
  struct Hit {
    int solid = 0;
    double fraction = 0.0;
    Vec3 normal = Vec3::Zero();
  };
  struct Side {
    Vec3 first = Vec3::Zero();
    Vec3 second = Vec3::Zero();  ///< the same as the first where one point will do
    double cost = 0.0;
  };

  std::optional<Hit> first_hit(const Vec3& a, const Vec3& b, double time_s);
  bool connect(const Vec3& a, const Vec3& b, double time_s, int depth);
  bool connect_within(const Vec3& a, const Vec3& b, double time_s, std::uint64_t looks);
  bool reach(const Vec3& a, const Vec3& b, double time_s, int halvings);
  bool over(const Vec3& a, const Vec3& b, double time_s);
  std::optional<Vec3> free_near(const Vec3& p, double step_m, double time_s);
  Vec3 center_at(std::size_t solid, double time_s, double height_m) const;
  int sides_of(const Hit& hit, const Vec3& a, const Vec3& b, double time_s, Side* sides);
  int sides_of_ground(const Hit& hit, const Vec3& a, const Vec3& b, Side* sides) const;
  bool push_out(Side& side, const Hit& hit, double time_s);
  double ground_need_m(const Vec3& p) const;
  bool free(const Vec3& p, double time_s);
  double duration_s(const Vec3& a, const Vec3& b) const;

  const ObstacleField& field_;
  NearbySolids& nearby_;
  VehicleLimits limits_;
  Rng* rng_ = nullptr;
  double noise_ = 0.0;
  std::uint64_t looks_ = 0;
  std::uint64_t max_looks_ = 0;
  std::uint64_t all_looks_ = 0;
  std::vector<Vec3> way_;
};

}  // namespace swallowtail::planner
