#include "coverage/field/ways.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "coverage/field/detail/free_ground.hpp"
#include "coverage/field/detail/geos.hpp"
#include "coverage/field/detail/visibility.hpp"

namespace swallowtail::coverage {
namespace {

using detail::FreeGround;

/// Nothing is between places as near as this, one of them beyond the border. A robot stops so near to where
/// it was sent.
constexpr double kBeside_m = 0.06;
/// Bends of one stretch of free ground that ways are looked for with; beyond, near ones are taken together,
/// and all are tried where no way is found so.
constexpr std::size_t kMostBends = 1600;
constexpr double kFirstTolerance_m = 0.1;
constexpr double kMostTolerance_m = 1.0;
/// Beyond the border, out of what is not crossed.
constexpr double kOut_m = 0.02;

/// So little within what is not crossed counts where no way is found else.
constexpr double kHair_m = 1e-9;

/// Of a hole, at the most, that its fields leave over when they fill it.
constexpr double kFilled = 0.01;

bool lies_in(const Polygon& field, const Polygon& hole) {
  return std::ranges::all_of(field.outline, [&](const Vec2& corner) {
    return contains(hole, corner) || border_distance_m(hole, corner) < detail::kTouch_m;
  });
}

/// Rings of the union, with the free ground to their left.
std::vector<Ring> rings_round(std::span<const Polygon> solid) {
  std::vector<Ring> out;
  const auto add = [&out](Ring ring, bool counter_clockwise) {
    if ((signed_area_m2(ring) > 0.0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
    out.push_back(std::move(ring));
  };
  for (const Polygon& part : detail::Shape::of(solid, detail::Shape::Vertices::kOnGrid).parts()) {
    add(part.outline, false);
    for (const Ring& hole : part.holes) add(hole, true);
  }
  return out;
}

double length_m(const Vec2& from, const std::vector<Vec2>& corners, const Vec2& to) {
  double out = 0.0;
  Vec2 at = from;
  for (const Vec2& corner : corners) {
    out += (corner - at).norm();
    at = corner;
  }
  return out + (to - at).norm();
}

}  // namespace

/// Free ground and what ways over it bend at.
class Ways::Domain {
 public:
  Domain(std::vector<Ring> rings, FreeGround::Far far);

  bool is_free(const Vec2& from, const Vec2& to) const {
    return is_beside(from, to) || ground_.is_free(from, to);
  }
  /// Ends this deep and more within what is not crossed are left straight first.
  std::optional<std::vector<Vec2>> corners(const Vec2& from, const Vec2& to, double least_m);

 private:
  bool is_beside(const Vec2& from, const Vec2& to) const;
  std::optional<Vec2> way_out(const Vec2& place, double least_m) const;
  std::optional<std::vector<Vec2>> between(const Vec2& from, const Vec2& to);

  FreeGround ground_;
  std::optional<detail::Visibility> visibility_;
  bool is_thinned_ = false;                  ///< near bends are taken together
  std::optional<detail::Visibility> whole_;  ///< of all bends, when they are needed
};

Ways::Domain::Domain(std::vector<Ring> rings, FreeGround::Far far) : ground_(std::move(rings), far) {
  std::vector<detail::Bend> bends = detail::bends_of(ground_.rings(), 0.0);
  for (double tolerance_m = kFirstTolerance_m; bends.size() > kMostBends && tolerance_m < kMostTolerance_m;
       tolerance_m *= 2.0) {
    bends = detail::bends_of(ground_.rings(), tolerance_m);
    is_thinned_ = true;
  }
  visibility_.emplace(ground_, std::move(bends));
}

std::optional<std::vector<Vec2>> Ways::Domain::between(const Vec2& from, const Vec2& to) {
  if (is_free(from, to)) return std::vector<Vec2>();
  auto found = visibility_->way(from, to);
  if (found || !is_thinned_) return found;
  if (!whole_) whole_.emplace(ground_, detail::bends_of(ground_.rings(), 0.0));
  return whole_->way(from, to);
}

bool Ways::Domain::is_beside(const Vec2& from, const Vec2& to) const {
  return (to - from).norm() < kBeside_m && !(ground_.contains(from) && ground_.contains(to));
}

/// From this deep and more within what is not crossed the straight way to the nearest place beside it;
/// nothing elsewhere.
std::optional<Vec2> Ways::Domain::way_out(const Vec2& place, double least_m) const {
  if (ground_.contains(place)) return std::nullopt;
  const Vec2 border = ground_.nearest_border(place);
  const double distance = (border - place).norm();
  if (distance < least_m) return std::nullopt;
  return Vec2(border + (border - place) * (kOut_m / distance));
}

std::optional<std::vector<Vec2>> Ways::Domain::corners(const Vec2& from, const Vec2& to, double least_m) {
  if (is_beside(from, to)) return std::vector<Vec2>();
  const std::optional<Vec2> out_of = way_out(from, least_m);
  const std::optional<Vec2> into = way_out(to, least_m);
  auto found = between(out_of.value_or(from), into.value_or(to));
  if (!found) return found;
  if (out_of) found->insert(found->begin(), *out_of);
  if (into) found->push_back(*into);
  return found;
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

std::vector<Polygon> holes_around_fields(std::span<const Polygon> polygons, std::span<const Polygon> fields) {
  std::vector<Polygon> out;
  for (const Polygon& polygon : polygons) {
    for (const Ring& ring : polygon.holes) {
      Polygon hole{Ring(ring.rbegin(), ring.rend()), {}};
      std::vector<Polygon> within;
      std::ranges::copy_if(fields, std::back_inserter(within),
                           [&](const Polygon& field) { return lies_in(field, hole); });
      if (within.empty()) continue;
      const detail::Shape rest = detail::Shape::of(hole).minus(detail::Shape::of(within));
      if (rest.area_m2() > kFilled * area_m2(hole)) out.push_back(std::move(hole));
    }
  }
  return out;
}

Ways::Ways() = default;
Ways::~Ways() = default;
Ways::Ways(Ways&&) noexcept = default;
Ways& Ways::operator=(Ways&&) noexcept = default;

Ways::Ways(std::span<const Polygon> fields, std::span<const Polygon> no_fly, std::span<const Polygon> around)
    : fields_(fields.begin(), fields.end()), around_(around.begin(), around.end()) {
  std::vector<Polygon> solid(no_fly.begin(), no_fly.end());
  std::ranges::move(holes_without_fields(fields, fields), std::back_inserter(solid));
  std::ranges::move(holes_around_fields(fields, fields), std::back_inserter(around_));
  for (const Polygon& field : fields) {
    std::vector<Ring> rings = field.holes;
    rings.push_back(field.outline);
    rooms_.push_back(std::make_unique<Domain>(std::move(rings), FreeGround::Far::kBarred));
  }
  open_ = std::make_unique<Domain>(rings_round(solid), FreeGround::Far::kFree);
  if (around_.empty()) return;
  solid.insert(solid.end(), around_.begin(), around_.end());
  outer_ = std::make_unique<Domain>(rings_round(solid), FreeGround::Far::kFree);
}

const Ways::Whereabouts& Ways::whereabouts(const Vec2& place) const {
  const auto [found, is_new] = whereabouts_.try_emplace({place.x(), place.y()});
  Whereabouts& out = found->second;
  if (!is_new) return out;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (contains(fields_[i], place) || border_distance_m(fields_[i], place) < detail::kTouch_m)
      out.rooms.push_back(i);
  }
  out.is_nested = std::ranges::any_of(around_, [&](const Polygon& hole) { return contains(hole, place); });
  return out;
}

std::vector<Ways::Domain*> Ways::common_rooms(const Vec2& from, const Vec2& to) const {
  // Both stay where they are: a map's values do not move.
  const std::vector<std::size_t>& here = whereabouts(from).rooms;
  const std::vector<std::size_t>& there = whereabouts(to).rooms;
  std::vector<Domain*> out;
  for (const std::size_t room : here) {
    if (std::ranges::find(there, room) != there.end()) out.push_back(rooms_[room].get());
  }
  return out;
}

Ways::Domain* Ways::open_ground(const Vec2& from, const Vec2& to) const {
  const bool is_nested = whereabouts(from).is_nested || whereabouts(to).is_nested;
  return outer_ != nullptr && !is_nested ? outer_.get() : open_.get();
}

std::optional<std::vector<Vec2>> Ways::find(const Vec2& from, const Vec2& to) const {
  std::optional<std::vector<Vec2>> best;
  double least_m = std::numeric_limits<double>::infinity();
  for (Domain* room : common_rooms(from, to)) {
    auto corners = room->corners(from, to, detail::kTouch_m);
    if (!corners) continue;
    const double length = length_m(from, *corners, to);
    if (length >= least_m) continue;
    least_m = length;
    best = std::move(corners);
  }
  if (best) return best;
  Domain* open = open_ground(from, to);
  best = open->corners(from, to, detail::kTouch_m);
  // A hair's breadth within, nothing is free along the border.
  return best ? best : open->corners(from, to, kHair_m);
}

std::optional<std::vector<Vec2>> Ways::corners(const Vec2& from, const Vec2& to) const {
  if (open_ == nullptr) return std::vector<Vec2>();
  if (!last_ || last_->from_m != from || last_->to_m != to) last_ = Bent{from, to, find(from, to)};
  return last_->corners_m;
}

bool Ways::is_free(const Vec2& from, const Vec2& to) const {
  if (open_ == nullptr) return true;
  const std::vector<Domain*> rooms = common_rooms(from, to);
  if (rooms.empty()) return open_ground(from, to)->is_free(from, to);
  return std::ranges::any_of(rooms, [&](const Domain* room) { return room->is_free(from, to); });
}

}  // namespace swallowtail::coverage
