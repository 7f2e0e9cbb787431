#pragma once

#include <vector>

#include "coverage/field/detail/ring_tree.hpp"
#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage::detail {

/// Of a straight way, may touch what is not crossed: rounding.
inline constexpr double kTouch_m = 2.5e-3;

/// Ground bounded by rings, to the left of every one of them, that straight ways may or may not cross.
class FreeGround {
 public:
  enum class Far { kFree, kBarred };  ///< what lies far away

  FreeGround(std::vector<Ring> rings, Far far);

  /// All but kTouch_m of the straight way. Not for several threads at once.
  bool is_free(const Vec2& from, const Vec2& to) const;
  bool contains(const Vec2& place) const;
  /// The nearest place on the border.
  Vec2 nearest_border(const Vec2& place) const;
  const std::vector<Ring>& rings() const { return rings_; }

 private:
  std::vector<Ring> rings_;
  RingTree tree_;
  Far far_;
  mutable std::vector<double> crossings_;
};

}  // namespace swallowtail::coverage::detail
