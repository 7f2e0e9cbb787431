#include "planner/world/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "planner/base/checks.hpp"
#include "planner/world/detail/box_tree.hpp"
#include "planner/world/detail/narrow_phase.hpp"

namespace swallowtail::planner {
namespace {

/// Boxes are this much larger than what they hold: more than rounding takes away.
constexpr double kBoxRoom_m = 1e-6;

/// A straight flight, in mission time.
struct Flight {
  Vec3 a, b;
  double t0_s, t1_s;
};

/// A point of the solid, relative to its position.
Vec3 inner_point(const Shape& shape) {
  if (const auto* c = std::get_if<Cylinder>(&shape)) return {0.0, 0.0, 0.5 * c->height_m};
  if (const auto* c = std::get_if<Cone>(&shape)) return {0.0, 0.0, 0.25 * c->height_m};
  if (const auto* m = std::get_if<ConvexMesh>(&shape)) {
    const double c = std::cos(m->yaw_rad);
    const double s = std::sin(m->yaw_rad);
    const Vec3& v = m->vertices_m.front();
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
  }
  return Vec3::Zero();
}

/// The solid with its margin, relative to its position.
Extent wide_extent(const Obstacle& obstacle) {
  Extent box = extent(obstacle.shape);
  box.min_m.array() -= obstacle.margin_m + kBoxRoom_m;
  box.max_m.array() += obstacle.margin_m + kBoxRoom_m;
  return box;
}

/// What a query gathers. No obstacle whose box, margin included, is farther than bound_m() can lower either
/// minimum: it is at most its distance, and at most its slack.
struct Search {
  const Flight& flight;
  double reach_m;
  Clearance answer{};
  double nearest_m = std::numeric_limits<double>::infinity();  ///< not below the least distance
  double least_m = std::numeric_limits<double>::infinity();    ///< not below the least slack

  double bound_m() const { return std::min(reach_m, std::max(nearest_m, least_m)); }
  void tighten(double distance_m, const Obstacle& solid) {
    nearest_m = std::min(nearest_m, distance_m);
    least_m = std::min(least_m, distance_m - solid.extra_m());
  }
};

}  // namespace

struct ClearanceQuery::Impl {
  explicit Impl(std::shared_ptr<const World> w);

  detail::Approach approach(std::size_t index, const Vec3& p, const Vec3& q) const;
  void measure(std::size_t index, Search& search) const;
  void among_standing(Search& search) const;
  void among_moving(Search& search) const;
  const Obstacle& obstacle(std::size_t index) const { return world->obstacles()[index]; }

  std::shared_ptr<const World> world;
  std::vector<std::uint32_t> standing;  ///< indexes in the world
  std::vector<std::uint32_t> moving;
  std::optional<detail::BoxTree> tree;  ///< of `standing`, same order
  /// Made when first asked for, by obstacle: most are never near.
  mutable std::vector<std::optional<detail::NarrowShape>> narrow;
};

ClearanceQuery::Impl::Impl(std::shared_ptr<const World> w)
    : world(std::move(w)), narrow(world->obstacles().size()) {
  std::vector<Extent> boxes;
  boxes.reserve(narrow.size());
  standing.reserve(narrow.size());
  for (std::uint32_t i = 0; i < narrow.size(); ++i) {
    if (obstacle(i).moves()) {
      moving.push_back(i);
      continue;
    }
    const Extent box = wide_extent(obstacle(i));
    boxes.push_back({obstacle(i).position_m + box.min_m, obstacle(i).position_m + box.max_m});
    standing.push_back(i);
  }
  tree.emplace(boxes);
}

detail::Approach ClearanceQuery::Impl::approach(std::size_t index, const Vec3& p, const Vec3& q) const {
  if (const auto* sphere = std::get_if<Sphere>(&obstacle(index).shape))
    return detail::sphere_to_segment(*sphere, p, q);
  if (!narrow[index]) narrow[index].emplace(obstacle(index).shape);
  return narrow[index]->to_segment(p, q);
}

void ClearanceQuery::Impl::measure(std::size_t index, Search& search) const {
  const Obstacle& solid = obstacle(index);
  const Flight& flight = search.flight;
  double t1_s = flight.t1_s;
  Vec3 b = flight.b;
  if (solid.valid_until_s < t1_s) {
    b = flight.a + (flight.b - flight.a) * ((solid.valid_until_s - flight.t0_s) / (t1_s - flight.t0_s));
    t1_s = solid.valid_until_s;
  }
  const Vec3 p = flight.a - solid.position_at(flight.t0_s);
  const Vec3 q = b - solid.position_at(t1_s);
  const detail::Approach nearest = approach(index, p, q);
  search.answer.distance_m = std::min(search.answer.distance_m, nearest.distance_m);
  search.tighten(nearest.distance_m, solid);
  if (nearest.distance_m - solid.extra_m() < search.answer.slack_m) {
    search.answer.slack_m = nearest.distance_m - solid.extra_m();
    search.answer.obstacle_id = solid.id;
    search.answer.time_s = flight.t0_s + (t1_s - flight.t0_s) * nearest.fraction;
  }
}

// First the bound from points inside the solids, which costs little; then the few that are left are measured.
void ClearanceQuery::Impl::among_standing(Search& search) const {
  const detail::SegmentProbe probe(search.flight.a, search.flight.b);
  tree->visit_near(probe, search.bound_m(), [&](std::uint32_t i) {
    const Obstacle& solid = obstacle(standing[i]);
    if (solid.valid_until_s >= search.flight.t1_s) {
      const double away = probe.distance_to(solid.position_m + inner_point(solid.shape));
      search.tighten(away + kBoxRoom_m, solid);
    }
    return search.bound_m();
  });
  tree->visit_near(probe, search.bound_m(), [&](std::uint32_t i) {
    if (obstacle(standing[i]).valid_until_s >= search.flight.t0_s) measure(standing[i], search);
    return search.bound_m();
  });
}

void ClearanceQuery::Impl::among_moving(Search& search) const {
  for (const std::uint32_t i : moving) {
    const Obstacle& solid = obstacle(i);
    if (solid.valid_until_s < search.flight.t0_s) continue;
    const detail::SegmentProbe relative(search.flight.a - solid.position_at(search.flight.t0_s),
                                        search.flight.b - solid.position_at(search.flight.t1_s));
    if (relative.comes_near(wide_extent(solid), search.bound_m())) measure(i, search);
  }
}

ClearanceQuery::ClearanceQuery(std::shared_ptr<const World> world)
    : impl_(std::make_unique<Impl>(std::move(world))) {}
ClearanceQuery::~ClearanceQuery() = default;
ClearanceQuery::ClearanceQuery(ClearanceQuery&&) noexcept = default;
ClearanceQuery& ClearanceQuery::operator=(ClearanceQuery&&) noexcept = default;

Clearance ClearanceQuery::of_flight(const Vec3& a, double t0_s, const Vec3& b, double t1_s,
                                    double reach_m) const {
  if (!is_finite(a) || !is_finite(b) || !is_finite(t0_s) || !is_finite(t1_s)) {
    return {0.0, -std::numeric_limits<double>::infinity(), 0, t0_s};  // never clear
  }
  const Flight flight{a, b, t0_s, t1_s};
  Search search{flight, std::max(reach_m, 0.0)};
  search.answer.time_s = t0_s;
  impl_->among_standing(search);
  impl_->among_moving(search);
  return search.answer;
}

const World& ClearanceQuery::world() const { return *impl_->world; }

}  // namespace swallowtail::planner
