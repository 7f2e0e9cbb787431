#include "coverage/field/ways.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <queue>

#include "coverage/field/detail/geos.hpp"
#include "coverage/field/detail/lines.hpp"
#include "coverage/field/detail/simplify.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kPush_m = 0.02;
/// Of a straight way, may touch what is not crossed: rounding.
constexpr double kTouch_m = 2.5e-3;
/// Nothing is between places as near as this. A robot stops so near to where it was sent, with luck just
/// beyond the border that the place is at.
constexpr double kBeside_m = 0.06;
/// Of the corners that ways bend at, by the work of seeing each from each past every edge; beyond, near ones
/// are taken together.
constexpr double kMostLooks = 1.6e9;
double most_corners(const std::vector<Ring>& rings) {
  double edges = 1.0;
  for (const Ring& ring : rings) edges += static_cast<double>(ring.size());
  return std::clamp(std::sqrt(kMostLooks / edges), 400.0, 1600.0);
}

bool lies_in(const Polygon& field, const Polygon& hole) {
  return std::ranges::all_of(field.outline, [&](const Vec2& corner) {
    return contains(hole, corner) || border_distance_m(hole, corner) < kTouch_m;
  });
}

}  // namespace

/// Free ground bounded by rings; to the left of every ring it is free.
class Ways::Domain {
 public:
  enum class Free { kInside, kOutside };

  Domain(std::vector<Ring> rings, Free free) : rings_(std::move(rings)), free_(free) {
    for (const Ring& ring : rings_) boxes_.push_back(bounds_of(ring));
    const double most = most_corners(rings_);
    double tolerance = 0.0;
    do {
      nodes_.clear();
      for (const Ring& ring : rings_) add_nodes(ring, tolerance);
      tolerance = tolerance > 0.0 ? tolerance * 2.0 : 0.1;
    } while (static_cast<double>(nodes_.size()) > most && tolerance < 1e4);
  }

  bool is_free(const Vec2& from, const Vec2& to) const;
  std::vector<Vec2> corners(const Vec2& from, const Vec2& to) const;

 private:
  /// What is seen of the nodes from a place, and how far they all are.
  struct View {
    std::vector<std::pair<int, double>> seen;
    std::vector<double> distance;
    std::vector<int> before;  ///< −1: the place itself
  };

  void add_nodes(const Ring& ring, double tolerance_m);
  const View& view_of(const Vec2& place) const;
  void see_each_other() const;

  std::vector<Ring> rings_;
  std::vector<Box> boxes_;  ///< of the rings
  Free free_;
  std::vector<Vec2> nodes_;
  mutable std::vector<std::vector<std::pair<int, double>>> links_;
  mutable std::map<std::pair<double, double>, View> views_;
  mutable std::vector<double> crossings_;
};

/// Corners where the free ground spans more than half a turn.
void Ways::Domain::add_nodes(const Ring& ring, double tolerance_m) {
  const std::vector<std::size_t> corners = detail::corners_of(ring, tolerance_m);
  const std::size_t count = corners.size() - 1;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2& at = ring[corners[k]];
    const Vec2 in = (at - ring[corners[(k + count - 1) % count]]).normalized();
    const Vec2 out = (ring[corners[k + 1] % ring.size()] - at).normalized();
    const double turn = in.x() * out.y() - in.y() * out.x();
    if (turn >= -1e-9 && in.dot(out) > -1.0 + 1e-9) continue;
    const Vec2 across = in - out;  // points away from what is not free
    const Vec2 push = across.norm() > 1e-9 ? Vec2(across.normalized()) : Vec2(in);
    nodes_.push_back(at + push * (kPush_m + tolerance_m));
  }
}

bool Ways::Domain::is_free(const Vec2& from, const Vec2& to) const {
  const double length = (to - from).norm();
  if (length < kTouch_m) return true;
  const detail::Line line = detail::line_through(from, to);
  crossings_.clear();
  const Vec2 lo = from.cwiseMin(to);
  const Vec2 hi = from.cwiseMax(to);
  for (std::size_t r = 0; r < rings_.size(); ++r) {
    // A ring beside the way is crossed beyond its ends only, as often in as out.
    if ((boxes_[r].lo.array() > hi.array()).any() || (boxes_[r].hi.array() < lo.array()).any()) continue;
    const Ring& ring = rings_[r];
    double left_a = line.left_of(ring.back());
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const double left_b = line.left_of(ring[i]);
      if ((left_a > 0.0) != (left_b > 0.0)) {
        const double a = line.along_of(ring[j]);
        crossings_.push_back(a + (line.along_of(ring[i]) - a) * left_a / (left_a - left_b));
      }
      left_a = left_b;
    }
  }
  std::sort(crossings_.begin(), crossings_.end());
  double blocked = 0.0;
  double at = 0.0;
  bool free = free_ == Free::kOutside;
  for (const double crossing : crossings_) {
    const double to_here = std::clamp(crossing, 0.0, length);
    if (!free) blocked += to_here - at;
    at = to_here;
    free = !free;
  }
  if (!free) blocked += length - at;
  return blocked <= kTouch_m;
}

void Ways::Domain::see_each_other() const {
  if (!links_.empty()) return;
  links_.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (std::size_t j = i + 1; j < nodes_.size(); ++j) {
      if (!is_free(nodes_[i], nodes_[j])) continue;
      const double distance = (nodes_[i] - nodes_[j]).norm();
      links_[i].emplace_back(static_cast<int>(j), distance);
      links_[j].emplace_back(static_cast<int>(i), distance);
    }
  }
}

/// Shortest distances over the nodes [DIJKSTRA].
const Ways::Domain::View& Ways::Domain::view_of(const Vec2& place) const {
  const auto [found, is_new] = views_.try_emplace({place.x(), place.y()});
  View& view = found->second;
  if (!is_new) return view;
  view.distance.assign(nodes_.size(), kFar);
  view.before.assign(nodes_.size(), -1);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!is_free(place, nodes_[i])) continue;
    view.distance[i] = (nodes_[i] - place).norm();
    view.seen.emplace_back(static_cast<int>(i), view.distance[i]);
  }
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const auto& [node, distance] : view.seen) open.emplace(distance, static_cast<std::size_t>(node));
  while (!open.empty()) {
    const auto [distance, next] = open.top();
    open.pop();
    if (distance > view.distance[next]) continue;
    for (const auto& [to, length] : links_[next]) {
      const auto other = static_cast<std::size_t>(to);
      if (distance + length >= view.distance[other]) continue;
      view.distance[other] = distance + length;
      view.before[other] = static_cast<int>(next);
      open.emplace(view.distance[other], other);
    }
  }
  return view;
}

std::vector<Vec2> Ways::Domain::corners(const Vec2& from, const Vec2& to) const {
  if (nodes_.empty() || is_free(from, to)) return {};
  see_each_other();
  // Both views stay where they are: a map's values do not move.
  const View& here = view_of(from);
  const View& there = view_of(to);
  int last = -1;
  double least = kFar;
  for (const auto& [node, distance] : there.seen) {
    const double total = here.distance[static_cast<std::size_t>(node)] + distance;
    if (total >= least) continue;
    least = total;
    last = node;
  }
  std::vector<Vec2> out;
  for (int node = last; node >= 0; node = here.before[static_cast<std::size_t>(node)])
    out.push_back(nodes_[static_cast<std::size_t>(node)]);
  std::reverse(out.begin(), out.end());
  return out;
}

std::vector<Polygon> holes_without_fields(std::span<const Polygon> polygons,
                                          std::span<const Polygon> fields) {
  std::vector<Polygon> out;
  for (const Polygon& polygon : polygons) {
    for (const Ring& ring : polygon.holes) {
      Polygon hole{Ring(ring.rbegin(), ring.rend()), {}};
      if (std::ranges::none_of(fields, [&](const Polygon& field) { return lies_in(field, hole); }))
        out.push_back(std::move(hole));
    }
  }
  return out;
}

Ways::Ways() = default;
Ways::~Ways() = default;
Ways::Ways(Ways&&) noexcept = default;
Ways& Ways::operator=(Ways&&) noexcept = default;

Ways::Ways(std::span<const Polygon> fields, std::span<const Polygon> no_fly) {
  std::vector<Polygon> solid(no_fly.begin(), no_fly.end());
  std::ranges::move(holes_without_fields(fields, fields), std::back_inserter(solid));
  for (const Polygon& field : fields) {
    std::vector<Ring> rings = field.holes;
    rings.push_back(field.outline);
    rooms_.push_back(std::make_unique<Domain>(std::move(rings), Domain::Free::kInside));
  }
  std::vector<Ring> rings;
  const auto add = [&rings](Ring ring, bool counter_clockwise) {
    if ((signed_area_m2(ring) > 0.0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
    rings.push_back(std::move(ring));
  };
  for (const Polygon& part : detail::Shape::of(solid).parts()) {
    add(part.outline, false);
    for (const Ring& hole : part.holes) add(hole, true);
  }
  open_ = std::make_unique<Domain>(std::move(rings), Domain::Free::kOutside);
  fields_.assign(fields.begin(), fields.end());
}

int Ways::room_of(const Vec2& place) const {
  const auto [found, is_new] = room_cache_.try_emplace({place.x(), place.y()}, -1);
  if (!is_new) return found->second;
  for (std::size_t i = 0; i < fields_.size() && found->second < 0; ++i) {
    if (contains(fields_[i], place) || border_distance_m(fields_[i], place) < kTouch_m)
      found->second = static_cast<int>(i);
  }
  return found->second;
}

const Ways::Domain* Ways::domain_of(const Vec2& from, const Vec2& to) const {
  const int room = room_of(from);
  if (room >= 0 && room == room_of(to)) return rooms_[static_cast<std::size_t>(room)].get();
  return open_.get();
}

std::vector<Vec2> Ways::corners(const Vec2& from, const Vec2& to) const {
  if ((to - from).norm() < kBeside_m) return {};
  if (last_ && last_->from_m == from && last_->to_m == to) return last_->corners_m;
  const Domain* domain = domain_of(from, to);
  last_ = Bent{from, to, domain == nullptr ? std::vector<Vec2>() : domain->corners(from, to)};
  return last_->corners_m;
}

bool Ways::is_free(const Vec2& from, const Vec2& to) const {
  if ((to - from).norm() < kBeside_m) return true;
  const Domain* domain = domain_of(from, to);
  return domain == nullptr || domain->is_free(from, to);
}

}  // namespace swallowtail::coverage
