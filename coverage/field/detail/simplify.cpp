#include "coverage/field/detail/simplify.hpp"

#include <algorithm>

#include "coverage/field/detail/lines.hpp"

namespace swallowtail::coverage::detail {
namespace {

constexpr double kRounding = 1e-9;

/// Splits a chain of border vertices where it leaves its chord by more than the tolerance [DOUGLAS-PEUCKER].
void split_chain(const Ring& ring, std::size_t first, std::size_t last, double tolerance_m,
                 std::vector<std::size_t>& out) {
  const Vec2& a = ring[first % ring.size()];
  const Vec2& b = ring[last % ring.size()];
  if (last - first > 1 && (b - a).norm() > kRounding) {
    const Line line = line_through(a, b);
    double farthest = tolerance_m;
    std::size_t at = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const Vec2& p = ring[i % ring.size()];
      const double s = std::clamp(line.along_of(p), 0.0, (b - a).norm());
      const double distance = (p - line.at(s)).norm();
      if (distance <= farthest) continue;
      farthest = distance;
      at = i;
    }
    if (at != first) {
      split_chain(ring, first, at, tolerance_m, out);
      split_chain(ring, at, last, tolerance_m, out);
      return;
    }
  }
  out.push_back(last);
}

}  // namespace

std::vector<std::size_t> corners_of(const Ring& ring, double tolerance_m) {
  std::size_t far = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    if ((ring[i] - ring[0]).squaredNorm() > (ring[far] - ring[0]).squaredNorm()) far = i;
  }
  std::vector<std::size_t> out{0};
  if (far > 0) split_chain(ring, 0, far, tolerance_m, out);
  split_chain(ring, far, ring.size(), tolerance_m, out);
  return out;
}

}  // namespace swallowtail::coverage::detail
