#include "coverage/field/detail/shades.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::coverage::detail {
namespace {

constexpr std::size_t kEdgesOfStretch = 8;
/// Rings of so few edges are one stretch.
constexpr std::size_t kEdgesOfWhole = 16;
/// Places nearer to a stretch's circle, as share of its radius, are taken to lie in it.
constexpr double kClear = 1.01;

}  // namespace

double Horizon::direction_of(const Vec2& way) {
  const double sum = std::abs(way.x()) + std::abs(way.y());
  if (!(sum > 0.0)) return 0.0;
  const double x = way.x() / sum;
  if (way.y() >= 0.0) return 1.0 - x;
  return 3.0 + x;
}

bool Horizon::is_shut(const Vec2& way) const {
  const auto sector =
      std::min(static_cast<std::size_t>(direction_of(way) * (kSectors / kTurn)), 64 * kWords - 1);
  return (shut_[sector / 64] >> (sector % 64) & 1U) != 0;
}

bool Horizon::is_shut() const {
  return std::ranges::all_of(shut_, [](std::uint64_t word) { return word == ~std::uint64_t{0}; });
}

void Horizon::shut(double from, double to) {
  constexpr double kRounding = 1e-9;
  const auto first = static_cast<std::int64_t>(std::ceil((from + kRounding) * (kSectors / kTurn)));
  const auto past = static_cast<std::int64_t>(std::floor((to - kRounding) * (kSectors / kTurn)));
  constexpr auto kCount = static_cast<std::int64_t>(64 * kWords);
  for (std::int64_t i = first; i < past; ++i) {
    const auto sector = static_cast<std::size_t>(((i % kCount) + kCount) % kCount);
    shut_[sector / 64] |= std::uint64_t{1} << (sector % 64);
  }
}

Shades::Shades(const std::vector<Ring>& rings) {
  std::vector<Vec2> middles;
  for (const Ring& ring : rings) {
    const std::size_t begin = vertices_.size();
    vertices_.insert(vertices_.end(), ring.begin(), ring.end());
    vertices_.push_back(ring.front());
    const std::size_t edges = ring.size() <= kEdgesOfWhole ? kEdgesOfWhole : kEdgesOfStretch;
    for (std::size_t first = begin; first + 1 < vertices_.size(); first += edges) {
      Stretch stretch{Vec2::Zero(), 0.0, first, std::min(first + edges, vertices_.size() - 1)};
      const std::vector<Vec2> all(vertices_.begin() + static_cast<std::ptrdiff_t>(stretch.first),
                                  vertices_.begin() + static_cast<std::ptrdiff_t>(stretch.last) + 1);
      const Box box = bounds_of(all);
      stretch.middle_m = (box.lo + box.hi) / 2.0;
      for (const Vec2& p : all) stretch.radius_m = std::max(stretch.radius_m, (p - stretch.middle_m).norm());
      most_radius_m_ = std::max(most_radius_m_, stretch.radius_m);
      middles.push_back(stretch.middle_m);
      stretches_.push_back(stretch);
    }
  }
  middles_ = PointGrid(std::move(middles));
}

void Shades::add(const Vec2& place, double from_m, double to_m, Horizon& horizon) const {
  middles_.for_each(place, std::max(0.0, from_m - most_radius_m_), to_m, [&](std::size_t i, double distance) {
    const Stretch& stretch = stretches_[i];
    const double end_m = distance + stretch.radius_m;
    if (end_m < from_m || end_m >= to_m || distance <= kClear * stretch.radius_m) return;
    // Connected as it is, and seen under less than half a turn, it hides all between its outermost vertices.
    const double first = Horizon::direction_of(vertices_[stretch.first] - place);
    double low = 0.0;
    double high = 0.0;
    for (std::size_t k = stretch.first + 1; k <= stretch.last; ++k) {
      double turned = Horizon::direction_of(vertices_[k] - place) - first;
      if (turned > Horizon::kTurn / 2.0) turned -= Horizon::kTurn;
      if (turned < -Horizon::kTurn / 2.0) turned += Horizon::kTurn;
      low = std::min(low, turned);
      high = std::max(high, turned);
    }
    horizon.shut(first + low, first + high);
  });
}

}  // namespace swallowtail::coverage::detail
