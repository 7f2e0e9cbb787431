#include "coverage/field/detail/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coverage/field/detail/simplify.hpp"

namespace swallowtail::coverage::detail {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kPush_m = 0.02;
/// Edges shorter than so many times the push do not say where ways may bend.
constexpr double kEdgePerPush = 10.0;
/// By how much more than the pushes tilt a line.
constexpr double kTilt = 2.0;
/// Rings of fewer vertices stay as they are.
constexpr std::size_t kLeastThinned = 40;
/// Bends in the first ring of a view, about.
constexpr double kBendsOfRing = 24.0;
/// By how much more than the straight way a way is first looked for, and then each time.
constexpr double kFirstDetour = 1.05;
constexpr double kMoreDetour = 1.5;
/// Distances kept by all searches together; beyond, they begin anew.
constexpr std::size_t kMostKept = 40'000'000;

std::vector<Vec2> places_of(const std::vector<Bend>& bends) {
  std::vector<Vec2> out;
  for (const Bend& bend : bends) out.push_back(bend.at_m);
  return out;
}

}  // namespace

std::vector<Bend> bends_of(const std::vector<Ring>& rings, double tolerance_m) {
  std::vector<Bend> out;
  for (const Ring& ring : rings) {
    const double straightened_m = ring.size() < kLeastThinned ? 0.0 : tolerance_m;
    const double push = kPush_m + straightened_m;
    const std::vector<std::size_t> corners = corners_of(ring, straightened_m);
    const std::size_t count = corners.size() - 1;
    for (std::size_t k = 0; k < count; ++k) {
      const Vec2& at = ring[corners[k]];
      const Vec2 from = at - ring[corners[(k + count - 1) % count]];
      const Vec2 to = ring[corners[k + 1] % ring.size()] - at;
      const Vec2 in = from.normalized();
      const Vec2 on = to.normalized();
      if (cross(in, on) >= -1e-9 && in.dot(on) > -1.0 + 1e-9) continue;
      const Vec2 across = in - on;  // points away from what is not free
      const Vec2 side = across.norm() > 1e-9 ? Vec2(across.normalized()) : in;
      const bool tells = std::min(from.norm(), to.norm()) >= kEdgePerPush * push;
      out.push_back({at + side * push, push, tells ? Vec2(-in) : Vec2::Zero(), tells ? on : Vec2::Zero()});
    }
  }
  return out;
}

Visibility::Visibility(const FreeGround& ground, std::vector<Bend> bends)
    : ground_(&ground),
      bends_(std::move(bends)),
      views_(bends_.size()),
      grid_(places_of(bends_)),
      shades_(ground.rings()),
      first_reach_m_(std::sqrt(grid_.share_m2() * kBendsOfRing / 3.0)) {}

double Visibility::ring_reach_m(std::size_t ring) const {
  return std::ldexp(first_reach_m_, static_cast<int>(ring));
}

/// Whether a taut way may lead from the place, itself a bend unless −1, to a bend: past both corners, not
/// into one.
bool Visibility::may_link(const Vec2& place, int from, int to) const {
  const Bend& there = bends_[static_cast<std::size_t>(to)];
  const Vec2 way = there.at_m - place;
  const double push = there.push_m + (from >= 0 ? bends_[static_cast<std::size_t>(from)].push_m : 0.0);
  const double tilt = kTilt * push;  // sines, times the way's length
  const auto passes = [&](const Bend& bend) {
    const double a = cross(way, bend.back);
    const double b = cross(way, bend.on);
    return !((a > tilt && b < -tilt) || (a < -tilt && b > tilt));
  };
  return passes(there) && (from < 0 || passes(bends_[static_cast<std::size_t>(from)]));
}

/// Adds the next ring to a view.
void Visibility::look_farther(View& view, const Vec2& place, int bend) const {
  const double to_m = ring_reach_m(view.past.size());
  grid_.for_each(place, view.reach_m, to_m, [&](std::size_t i, double distance) {
    const auto other = static_cast<int>(i);
    const Vec2& at = bends_[i].at_m;
    if (other == bend || view.horizon.is_shut(at - place) || !may_link(place, bend, other)) return;
    if (bend < other ? ground_->is_free(place, at) : ground_->is_free(at, place))
      view.seen.push_back({other, distance});
  });
  shades_.add(place, view.reach_m, to_m, view.horizon);
  view.past.push_back(view.seen.size());
  view.reach_m = to_m;
  view.is_whole = to_m > grid_.farthest_m(place) || view.horizon.is_shut();
}

Visibility::Search& Visibility::search_from(const Vec2& place) {
  return searches_.try_emplace({place.x(), place.y()}).first->second;
}

/// Until all that is nearer than `to_m` is found.
void Visibility::go_on(Search& search, const Vec2& place, double to_m) {
  if (search.distance_m.empty()) {
    search.distance_m.assign(bends_.size(), kFar);
    search.before.assign(bends_.size(), -1);
    search.ahead.push({0.0, -1, 0});
  }
  while (!search.ahead.empty() && search.ahead.top().distance_m < to_m) {
    const Ahead next = search.ahead.top();
    search.ahead.pop();
    const auto bend = static_cast<std::size_t>(next.bend);
    const double so_far = next.bend < 0 ? 0.0 : search.distance_m[bend];
    if (next.ring == 0 && next.distance_m > so_far) continue;
    View& view = next.bend < 0 ? search.view : views_[bend];
    const Vec2& at = next.bend < 0 ? place : bends_[bend].at_m;
    if (next.ring == view.past.size()) look_farther(view, at, next.bend);
    for (std::size_t i = next.ring == 0 ? 0 : view.past[next.ring - 1]; i < view.past[next.ring]; ++i) {
      const auto other = static_cast<std::size_t>(view.seen[i].bend);
      const double distance = so_far + view.seen[i].distance_m;
      if (distance >= search.distance_m[other]) continue;
      search.distance_m[other] = distance;
      search.before[other] = next.bend;
      search.ahead.push({distance, view.seen[i].bend, 0});
    }
    if (next.ring + 1 < view.past.size() || !view.is_whole)
      search.ahead.push({so_far + ring_reach_m(next.ring), next.bend, next.ring + 1});
  }
}

std::optional<std::vector<Vec2>> Visibility::way(const Vec2& from, const Vec2& to) {
  if (bends_.empty()) return std::nullopt;
  if (searches_.size() * bends_.size() > kMostKept) searches_.clear();
  // Both stay where they are: a map's values do not move.
  Search& here = search_from(from);
  View& there = search_from(to).view;
  int last = -1;
  double least = kFar;
  for (double within_m = kFirstDetour * (to - from).norm();;) {
    go_on(here, from, within_m);
    while (!there.is_whole && there.reach_m < within_m) look_farther(there, to, -1);
    for (const Seen& seen : there.seen) {
      const double total = here.distance_m[static_cast<std::size_t>(seen.bend)] + seen.distance_m;
      if (total > least || (total == least && seen.bend >= last) || total == kFar) continue;
      least = total;
      last = seen.bend;
    }
    if (least <= within_m || (here.ahead.empty() && there.is_whole)) break;
    within_m = std::min(least, kMoreDetour * within_m);
  }
  if (last < 0) return std::nullopt;
  std::vector<Vec2> out;
  for (int bend = last; bend >= 0; bend = here.before[static_cast<std::size_t>(bend)])
    out.push_back(bends_[static_cast<std::size_t>(bend)].at_m);
  std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace swallowtail::coverage::detail
