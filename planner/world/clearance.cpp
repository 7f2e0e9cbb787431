#include "planner/world/clearance.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "planner/base/checks.hpp"
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

/// The box of a solid, its margin included, at its place; lives in the broad phase. FCL wants a geometry to
/// take the box from.
fcl::CollisionObjectd box_object(const Vec3& min_m, const Vec3& max_m) {
  fcl::CollisionObjectd object(std::make_shared<fcl::Boxd>(max_m - min_m), fcl::Matrix3d::Identity(),
                               0.5 * (min_m + max_m));
  object.computeAABB();
  return object;
}

}  // namespace

struct ClearanceQuery::Impl {
  struct Solid {
    const Obstacle* obstacle;
    detail::NarrowShape narrow;
    Extent extent;  ///< margin included, relative to the position
  };

  explicit Impl(std::shared_ptr<const World> w);

  /// What a traversal of the tree carries along.
  struct Search {
    const Impl* query;
    const Flight* flight;
    Clearance answer;
    double reach_m;
  };
  static bool visit(fcl::CollisionObjectd* first, fcl::CollisionObjectd* second, void* data, double& bound);
  void measure(const Solid& solid, Search& search) const;
  bool sweeps_past(const Solid& solid, const Search& search) const;

  std::shared_ptr<const World> world;
  std::vector<Solid> standing;
  std::vector<Solid> moving;
  std::vector<fcl::CollisionObjectd> boxes;  ///< of `standing`, same order
  fcl::DynamicAABBTreeCollisionManagerd tree;
};

ClearanceQuery::Impl::Impl(std::shared_ptr<const World> w) : world(std::move(w)) {
  for (const Obstacle& obstacle : world->obstacles()) {
    Extent box = extent(obstacle.shape);
    box.min_m.array() -= obstacle.margin_m + kBoxRoom_m;
    box.max_m.array() += obstacle.margin_m + kBoxRoom_m;
    (obstacle.moves() ? moving : standing).push_back({&obstacle, detail::NarrowShape(obstacle.shape), box});
  }
  boxes.reserve(standing.size());
  for (Solid& solid : standing) {
    boxes.push_back(box_object(solid.obstacle->position_m + solid.extent.min_m,
                               solid.obstacle->position_m + solid.extent.max_m));
    boxes.back().setUserData(&solid);
  }
  std::vector<fcl::CollisionObjectd*> pointers;
  pointers.reserve(boxes.size());
  for (auto& box : boxes) pointers.push_back(&box);
  tree.registerObjects(pointers);
  tree.setup();
}

// Every slack is at most its distance, so what is farther than the least distance so far (its box holds the
// margin) can lower neither minimum.
bool ClearanceQuery::Impl::visit(fcl::CollisionObjectd* first, fcl::CollisionObjectd* second, void* data,
                                 double& bound) {
  auto& search = *static_cast<Search*>(data);
  const void* solid = first->getUserData() != nullptr ? first->getUserData() : second->getUserData();
  search.query->measure(*static_cast<const Solid*>(solid), search);
  // Not 0: FCL descends where the boxes' distance is less than the bound, and boxes that overlap (0) may
  // still hold a lesser slack.
  bound = std::max(std::min(search.reach_m, search.answer.distance_m), std::numeric_limits<double>::min());
  return false;
}

void ClearanceQuery::Impl::measure(const Solid& solid, Search& search) const {
  const Obstacle& obstacle = *solid.obstacle;
  const Flight& flight = *search.flight;
  if (obstacle.valid_until_s < flight.t0_s) return;
  double t1_s = flight.t1_s;
  Vec3 b = flight.b;
  if (obstacle.valid_until_s < t1_s) {
    b = flight.a + (flight.b - flight.a) * ((obstacle.valid_until_s - flight.t0_s) / (t1_s - flight.t0_s));
    t1_s = obstacle.valid_until_s;
  }
  const Vec3 p = flight.a - obstacle.position_at(flight.t0_s);
  const Vec3 q = b - obstacle.position_at(t1_s);
  const detail::Approach approach = solid.narrow.to_segment(p, q);
  search.answer.distance_m = std::min(search.answer.distance_m, approach.distance_m);
  if (approach.distance_m - obstacle.margin_m < search.answer.slack_m) {
    search.answer.slack_m = approach.distance_m - obstacle.margin_m;
    search.answer.obstacle_id = obstacle.id;
    search.answer.time_s = flight.t0_s + (t1_s - flight.t0_s) * approach.fraction;
  }
}

bool ClearanceQuery::Impl::sweeps_past(const Solid& solid, const Search& search) const {
  const Vec3 p = search.flight->a - solid.obstacle->position_at(search.flight->t0_s);
  const Vec3 q = search.flight->b - solid.obstacle->position_at(search.flight->t1_s);
  const Vec3 gap =
      (p.cwiseMin(q) - solid.extent.max_m).cwiseMax(solid.extent.min_m - p.cwiseMax(q)).cwiseMax(0.0);
  const double bound = std::min(search.reach_m, search.answer.distance_m);
  return gap.squaredNorm() > bound * bound;
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
  Impl::Search search{impl_.get(), &flight, {}, std::max(reach_m, 0.0)};
  search.answer.time_s = t0_s;
  if (!impl_->standing.empty()) {
    fcl::CollisionObjectd swept = box_object(a.cwiseMin(b), a.cwiseMax(b));
    impl_->tree.distance(&swept, &search, &Impl::visit);
  }
  for (const auto& solid : impl_->moving) {
    if (!impl_->sweeps_past(solid, search)) impl_->measure(solid, search);
  }
  return search.answer;
}

const World& ClearanceQuery::world() const { return *impl_->world; }

}  // namespace swallowtail::planner
