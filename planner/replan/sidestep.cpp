#include "planner/replan/sidestep.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/path/detail/terrain_rule.hpp"
#include "planner/replan/ground_probe.hpp"

namespace swallowtail::planner {
namespace {

/// A side is passed at this much more than the distance to keep.
constexpr double kRoom = 1.01;
/// How far a point beside a ball may stand off at most, so that both its hops pass: in radii.
constexpr double kFarthestCorner = 2.0;
constexpr int kDeepest = 12;
/// Hops looked at before a way is halved, and how often it is.
constexpr std::uint64_t kTry = 80;
constexpr int kHalvings = 7;
/// Height in widths.
constexpr double kTall = 3.0;
/// A point that is not free is moved outwards by these factors.
constexpr std::array kPushes{0.3, 0.8, 1.6};

Vec3 any_normal(const Vec3& direction) {
  const Vec3 side = direction.cross(Vec3::UnitZ());
  return side.squaredNorm() > 1e-12 ? Vec3(side.normalized()) : Vec3(Vec3::UnitY());
}

}  // namespace

Sidestep::Sidestep(const ObstacleField& field, NearbySolids& nearby, const VehicleLimits& limits)
    : field_(field), nearby_(nearby), limits_(limits) {}

double Sidestep::duration_s(const Vec3& a, const Vec3& b) const {
  if (!field_.anything_moves()) return 0.0;
  const Vec3 d = b - a;
  const double climb = d.z() > 0.0 ? d.z() / limits_.climb_speed_mps : -d.z() / limits_.descent_speed_mps;
  return std::max(climb, d.norm() / limits_.cruise_speed_mps);
}

double Sidestep::ground_need_m(const Vec3& p) const {
  return std::max(height_to_keep_m(field_.world().terrain(), p.head<2>(), limits_.clearance_m()),
                  field_.ground_clearance_m());
}

bool Sidestep::free(const Vec3& p, double time_s) {
  const Terrain& terrain = field_.world().terrain();
  if (p.z() - terrain.height_at(p.x(), p.y()) < ground_need_m(p)) return false;
  for (const std::uint32_t i : nearby_.along(p, p, 0.0)) {
    if (field_.violation_m(i, p, time_s, p, time_s) > 0.0) return false;
  }
  return true;
}

std::optional<Sidestep::Hit> Sidestep::first_hit(const Vec3& a, const Vec3& b, double time_s) {
  ++looks_;
  const double end_s = time_s + duration_s(a, b);
  std::optional<Hit> first;
  for (const std::uint32_t i : nearby_.along(a, b, 0.0)) {
    if (!field_.near(i, a, time_s, b, end_s, 0.0)) continue;
    const Approach approach = field_.approach(i, a, time_s, b, end_s);
    if (approach.signed_distance_m >= field_.required_m(i)) continue;
    if (first && approach.fraction >= first->fraction) continue;
    first = Hit{static_cast<int>(i), approach.fraction, approach.normal};
  }
  const Terrain& terrain = field_.world().terrain();
  const Vec2 lo = a.cwiseMin(b).head<2>();
  const Vec2 hi = a.cwiseMax(b).head<2>();
  if (std::min(a.z(), b.z()) - terrain.max_in(lo, hi) >= 3.0 * field_.ground_clearance_m()) return first;
  const double until = first ? first->fraction : 1.0;
  const Vec3 end = a + until * (b - a);
  const double clearance = field_.ground_clearance_m();
  if (terrain.min_height_above(a, end) < clearance) {
    const GroundContact low = lowest_over(terrain, a, b, 0.0, until);
    if (low.height_m < clearance) return Hit{kGround, low.fraction, Vec3::UnitZ()};
  }
  const auto fault = detail::find_terrain_fault(terrain, a, end, limits_.clearance_m());
  if (!fault) return first;
  return Hit{kGround, until * fault->fraction, Vec3::UnitZ()};
}

bool Sidestep::clear(const Vec3& a, const Vec3& b, double time_s) { return !first_hit(a, b, time_s); }

int Sidestep::sides_of_ground(const Hit& hit, const Vec3& a, const Vec3& b, Side* sides) const {
  const Terrain& terrain = field_.world().terrain();
  const Bounds& bounds = field_.world().bounds();
  const Vec3 low = a + hit.fraction * (b - a);
  int count = 0;
  // A hill is round: both hops pass it if the point between them stands higher than the ground below.
  const double need = kRoom * ground_need_m(low);
  const double deep = std::max(need + terrain.height_at(low.x(), low.y()) - low.z(), 0.2 * need);
  for (const double lift : {1.15, 1.8}) {
    const Vec3 above(low.x(), low.y(), low.z() + lift * deep);
    if (bounds.contains(above)) sides[count++] = {above, above, 0.0};
  }
  const Vec2 along = (b - a).head<2>();
  if (along.norm() == 0.0) return count;
  const Vec2 level = Vec2(-along.y(), along.x()).normalized();
  const double step = 0.02 * (b - a).norm();
  for (const double hand : {1.0, -1.0}) {
    double reach = step;
    for (int k = 0; k < 24; ++k, reach *= 1.25) {
      Vec3 beside = low;
      beside.head<2>() += hand * reach * level;
      if (!bounds.contains(beside)) break;
      const double height = beside.z() - terrain.height_at(beside.x(), beside.y());
      if (height < kRoom * field_.ground_clearance_m() || height < kRoom * ground_need_m(beside)) continue;
      sides[count++] = {beside, beside, 0.0};
      break;
    }
  }
  return count;
}

/// A prism far taller than wide (a no-fly area) is passed at the height flown, not at that of its middle.
Vec3 Sidestep::center_at(std::size_t solid, double time_s, double height_m) const {
  Vec3 center = field_.ball_center_m(solid, time_s);
  const Vec3& half = field_.solids()[solid].half_extent_m;
  if (field_.solids()[solid].has_directions && half.z() > kTall * half.head<2>().maxCoeff())
    center.z() = std::clamp(height_m, center.z() - half.z(), center.z() + half.z());
  return center;
}

int Sidestep::sides_of(const Hit& hit, const Vec3& a, const Vec3& b, double time_s, Side* sides) {
  if (hit.solid == kGround) return sides_of_ground(hit, a, b, sides);
  const auto solid = static_cast<std::size_t>(hit.solid);
  const Vec3 d = (b - a).normalized();
  const double met_s = time_s + hit.fraction * duration_s(a, b);
  const bool round = field_.solids()[solid].kind == detail::SolidKind::kSphere;
  const Vec3 center = center_at(solid, met_s, a.z() + hit.fraction * (b - a).z());
  const double lift = center.z() - field_.ball_center_m(solid, met_s).z();
  const double ahead = d.dot(center - a);
  const double behind = d.dot(b - center);
  Vec3 n = hit.normal - d * d.dot(hit.normal);
  n = n.squaredNorm() > 1e-12 ? Vec3(n.normalized()) : any_normal(d);
  const Vec3 m = d.cross(n);
  const double required = field_.required_m(solid);
  const double depth = field_.half_width_m(solid, d);
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kSides;
    const Vec3 u = std::cos(angle) * n + std::sin(angle) * m;
    const double reach = kRoom * (field_.half_width_m(solid, u) + required) - lift * u.z();
    double corner = 1.0;
    if (round) {
      for (const double away : {ahead, behind}) {
        const double share = away * away > reach * reach
                                 ? std::abs(away) / std::sqrt(away * away - reach * reach)
                                 : kFarthestCorner;
        corner = std::max(corner, std::min(share, kFarthestCorner));
      }
      sides[k].first = sides[k].second = center + corner * reach * u;
      continue;
    }
    const double half = std::min({depth + required, std::max(0.0, 0.8 * ahead), std::max(0.0, 0.8 * behind)});
    sides[k].first = center + reach * u - half * d;
    sides[k].second = center + reach * u + half * d;
  }
  return kSides;
}

/// A side that something else shuts is tried farther out.
bool Sidestep::push_out(Side& side, const Hit& hit, double time_s) {
  if (hit.solid == kGround) return false;
  const Bounds& bounds = field_.world().bounds();
  const Vec3 middle = 0.5 * (side.first + side.second);
  const Vec3 out = middle - center_at(static_cast<std::size_t>(hit.solid), time_s, middle.z());
  for (const double push : kPushes) {
    const Vec3 more = push * out;
    if (!bounds.contains(side.first + more) || !bounds.contains(side.second + more)) return false;
    if (!free(side.first + more, time_s)) continue;
    side.first += more;
    side.second += more;
    return true;
  }
  return false;
}

bool Sidestep::connect(const Vec3& a, const Vec3& b, double time_s, int depth) {
  if (looks_ >= max_looks_) return false;
  const std::optional<Hit> hit = first_hit(a, b, time_s);
  if (!hit) {
    way_.push_back(b);
    return true;
  }
  if (depth >= kDeepest) return false;
  std::array<Side, kSides> sides;
  const int count = sides_of(*hit, a, b, time_s, sides.data());
  const double straight = (b - a).norm();
  const Bounds& bounds = field_.world().bounds();
  for (int k = 0; k < count; ++k) {
    Side& side = sides[static_cast<std::size_t>(k)];
    side.first = side.first.cwiseMax(bounds.min_m).cwiseMin(bounds.max_m);
    side.second = side.second.cwiseMax(bounds.min_m).cwiseMin(bounds.max_m);
    side.cost = (side.first - a).norm() + (side.second - side.first).norm() + (b - side.second).norm();
    if (noise_ > 0.0) side.cost += noise_ * straight * rng_->uniform();
  }
  for (int k = 1; k < count; ++k) {
    for (int j = k;
         j > 0 && sides[static_cast<std::size_t>(j)].cost < sides[static_cast<std::size_t>(j) - 1].cost; --j)
      std::swap(sides[static_cast<std::size_t>(j)], sides[static_cast<std::size_t>(j) - 1]);
  }
  const std::size_t mark = way_.size();
  for (int k = 0; k < count; ++k) {
    Side side = sides[static_cast<std::size_t>(k)];
    const double first_s = time_s + duration_s(a, side.first);
    if (!free(side.first, first_s) && !push_out(side, *hit, first_s)) continue;
    const double second_s = first_s + duration_s(side.first, side.second);
    const bool nearer = hit->solid != kGround && (b - side.second).norm() < straight;
    const bool there = connect(a, side.first, time_s, depth + 1) &&
                       (side.first == side.second || connect(side.first, side.second, first_s, depth + 1)) &&
                       connect(side.second, b, second_s, nearer ? depth : depth + 1);
    if (there) return true;
    way_.resize(mark);
    if (looks_ >= max_looks_) return false;
  }
  return false;
}

bool Sidestep::connect_within(const Vec3& a, const Vec3& b, double time_s, std::uint64_t looks) {
  const std::size_t mark = way_.size();
  max_looks_ = std::min(all_looks_, looks_ + looks);
  if (connect(a, b, time_s, 0)) return true;
  way_.resize(mark);
  return false;
}

std::optional<Vec3> Sidestep::free_near(const Vec3& p, double step_m, double time_s) {
  const Bounds& bounds = field_.world().bounds();
  const Terrain& terrain = field_.world().terrain();
  Vec3 start = p;
  start.z() = std::max(start.z(), terrain.height_at(p.x(), p.y()) + kRoom * ground_need_m(p));
  if (bounds.contains(start) && free(start, time_s)) return start;
  const std::array<Vec3, 5> ways{Vec3::UnitZ(), Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitY()};
  double away = step_m;
  for (int k = 0; k < 8; ++k, away *= 1.6) {
    for (const Vec3& way : ways) {
      const Vec3 q = start + away * way;
      if (bounds.contains(q) && free(q, time_s)) return q;
    }
  }
  return std::nullopt;
}

bool Sidestep::over(const Vec3& a, const Vec3& b, double time_s) {
  const Vec2 lo = a.cwiseMin(b).head<2>();
  const Vec2 hi = a.cwiseMax(b).head<2>();
  const Terrain& terrain = field_.world().terrain();
  double top = std::max({a.z(), b.z(), terrain.max_in(lo, hi) + 1.5 * field_.ground_clearance_m()});
  for (const std::uint32_t i : nearby_.along(a, b, 0.0)) {
    if (!field_.near(i, Vec3(a.x(), a.y(), top), time_s, Vec3(b.x(), b.y(), top), time_s, 0.0)) continue;
    const double half = field_.half_width_m(i, Vec3::UnitZ());
    top = std::max(top, field_.ball_center_m(i, time_s).z() + half + kRoom * field_.required_m(i));
  }
  top = std::min(top, field_.world().bounds().max_m.z());
  const Vec3 up(a.x(), a.y(), top);
  const Vec3 down(b.x(), b.y(), top);
  const double up_s = time_s + duration_s(a, up);
  const double down_s = up_s + duration_s(up, down);
  return connect_within(a, up, time_s, kTry) && connect_within(up, down, up_s, kTry) &&
         connect_within(down, b, down_s, kTry);
}

bool Sidestep::reach(const Vec3& a, const Vec3& b, double time_s, int halvings) {
  if (connect_within(a, b, time_s, kTry)) return true;
  if (looks_ >= all_looks_) return false;
  const std::size_t mark = way_.size();
  if (halvings > 0) {
    const double half_s = 0.5 * duration_s(a, b);
    const std::optional<Vec3> middle = free_near(0.5 * (a + b), 0.02 * (b - a).norm(), time_s + half_s);
    if (middle && reach(a, *middle, time_s, halvings - 1) && reach(*middle, b, time_s + half_s, halvings - 1))
      return true;
    way_.resize(mark);
    if (looks_ >= all_looks_) return false;
  }
  if (over(a, b, time_s)) return true;
  way_.resize(mark);
  return false;
}

void Sidestep::straighten(std::vector<Vec3>& chain, double start_time_s) {
  constexpr std::size_t kAhead = 8;
  std::size_t kept = 0;
  double time_s = start_time_s;
  for (std::size_t i = 0; i + 1 < chain.size();) {
    std::size_t next = i + 1;
    for (std::size_t j = std::min(i + kAhead, chain.size() - 1); j > i + 1; --j) {
      if (!clear(chain[i], chain[j], time_s)) continue;
      next = j;
      break;
    }
    time_s += duration_s(chain[i], chain[next]);
    chain[++kept] = chain[next];
    // What is written lies at or before what is read next.
    i = next;
    chain[kept] = chain[next];
  }
  chain.resize(kept + 1);
}

void Sidestep::find(const Vec3& from, const Vec3& to, double start_time_s, double noise, Rng& rng,
                    std::uint64_t max_looks, std::vector<Vec3>& chain) {
  rng_ = &rng;
  noise_ = noise;
  looks_ = 0;
  all_looks_ = max_looks;
  way_.clear();
  way_.push_back(from);
  chain.clear();
  if (!reach(from, to, start_time_s, kHalvings)) return;
  chain = way_;
  straighten(chain, start_time_s);
}

}  // namespace swallowtail::planner
