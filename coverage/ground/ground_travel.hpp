#pragma once

#include <limits>
#include <vector>

#include "planner/base/vec.hpp"

namespace swallowtail::coverage {

/// How long it takes the ground robot from one place to another, and on which way. Level coordinates; ways
/// between places where it may stop are as long one way as the other. Safe for several threads at once.
class GroundTravel {
 public:
  virtual ~GroundTravel() = default;

  /// Seconds; infinite when the robot cannot get there.
  virtual double drive_s(const Vec2& from, const Vec2& to) const = 0;
  /// Where that way bends, in order, both ends left out; empty when it is straight, or there is none.
  virtual std::vector<Vec2> bends(const Vec2& from, const Vec2& to) const = 0;
};

}  // namespace swallowtail::coverage
