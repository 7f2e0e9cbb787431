#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "coverage/field/detail/point_grid.hpp"
#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage::detail {

/// The directions, in sectors, in which nothing is seen any more.
class Horizon {
 public:
  bool is_shut(const Vec2& way) const;
  bool is_shut() const;
  /// What lies wholly between two directions, by direction_of; the second may be beyond a turn.
  void shut(double from, double to);

  /// Grows with the angle, counter-clockwise; a turn is kTurn.
  static double direction_of(const Vec2& way);
  static constexpr double kTurn = 4.0;

 private:
  static constexpr std::size_t kWords = 16;
  static constexpr double kSectors = 64.0 * kWords;
  std::array<std::uint64_t, kWords> shut_{};
};

/// What stretches of rings hide of what lies behind them.
class Shades {
 public:
  explicit Shades(const std::vector<Ring>& rings);

  /// Shuts the directions hidden from a place by the stretches that end, seen from there, no nearer than
  /// `from_m` and nearer than `to_m`. Beyond `to_m` nothing is seen in them.
  void add(const Vec2& place, double from_m, double to_m, Horizon& horizon) const;

 private:
  struct Stretch {
    Vec2 middle_m = Vec2::Zero();  ///< of a circle of radius_m around it
    double radius_m = 0.0;
    std::size_t first = 0;  ///< vertices
    std::size_t last = 0;
  };

  std::vector<Vec2> vertices_;
  std::vector<Stretch> stretches_;
  double most_radius_m_ = 0.0;
  PointGrid middles_{{}};
};

}  // namespace swallowtail::coverage::detail
