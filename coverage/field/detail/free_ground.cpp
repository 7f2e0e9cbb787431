#include "coverage/field/detail/free_ground.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace swallowtail::coverage::detail {

FreeGround::FreeGround(std::vector<Ring> rings, Far far)
    : rings_(std::move(rings)), tree_(rings_), far_(far) {}

bool FreeGround::is_free(const Vec2& from, const Vec2& to) const {
  const double length = (to - from).norm();
  if (length < kTouch_m) return true;
  crossings_.clear();
  bool free = (far_ == Far::kFree) != tree_.add_crossings(from, to, crossings_);
  std::sort(crossings_.begin(), crossings_.end());
  double blocked = 0.0;
  double at = 0.0;
  for (const double crossing : crossings_) {
    const double to_here = std::clamp(crossing, 0.0, length);
    if (!free) blocked += to_here - at;
    at = to_here;
    free = !free;
  }
  if (!free) blocked += length - at;
  return blocked <= kTouch_m;
}

bool FreeGround::contains(const Vec2& place) const {
  crossings_.clear();
  bool free = (far_ == Far::kFree) != tree_.add_crossings(place, place + Vec2(1.0, 0.0), crossings_);
  for (const double crossing : crossings_) {
    if (crossing < 0.0) free = !free;
  }
  return free;
}

Vec2 FreeGround::nearest_border(const Vec2& place) const {
  Vec2 nearest = place;
  double least = std::numeric_limits<double>::infinity();
  for (const Ring& ring : rings_) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Vec2 edge = ring[i] - ring[j];
      const double t =
          std::clamp((place - ring[j]).dot(edge) / std::max(edge.squaredNorm(), 1e-18), 0.0, 1.0);
      const Vec2 at = ring[j] + t * edge;
      if ((at - place).squaredNorm() >= least) continue;
      least = (at - place).squaredNorm();
      nearest = at;
    }
  }
  return nearest;
}

}  // namespace swallowtail::coverage::detail
