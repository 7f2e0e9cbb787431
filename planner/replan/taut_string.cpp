#include "planner/replan/taut_string.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/replan/ground_probe.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kNearOfScale = 0.08;
constexpr double kNearOfHop = 0.25;
constexpr double kMeanHops = 3.0;
constexpr int kFlatPieces = 2;
constexpr int kGroundPieces = 4;
/// Points that come nearer to each other than this share of the scale count as that far apart in derivatives.
constexpr double kSoft = 1e-4;
/// Spare room beyond the field's own, as shares of the obstacle's size and of the scale.
constexpr double kSpareOfSize = 4e-5;
constexpr double kSpareOfScale = 1e-5;
constexpr double kLongestStep = 0.75;  ///< in reaches of `near_m_`
constexpr double kEnough = 1e-8;

bool is_sphere(const ObstacleField& field, std::size_t solid) {
  return field.solids()[solid].kind == detail::SolidKind::kSphere;
}

double soft_norm(double square, double soft) { return std::sqrt(square + soft * soft); }

}  // namespace

double flown_length_m(const Vec3& hop, double steepest) {
  const double level = std::sqrt(hop.x() * hop.x() + hop.y() * hop.y());
  const double rise = std::abs(hop.z());
  if (rise <= steepest * level) return hop.norm();
  return rise - steepest * level + level * std::sqrt(1.0 + steepest * steepest);
}

double flown_length_m(const std::vector<Vec3>& chain, double steepest) {
  double length = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) length += flown_length_m(chain[i] - chain[i - 1], steepest);
  return length;
}

TautString::TautString(const ObstacleField& field, NearbySolids& nearby, const VehicleLimits& limits,
                       double distance_m)
    : field_(field),
      nearby_(nearby),
      limits_(limits),
      distance_m_(distance_m),
      scale_m_(distance_m),
      steepest_(std::tan(limits.climb_max_rad)) {}

double TautString::required_m(std::size_t solid) const {
  const double least = field_.required_m(solid);
  return least +
         reserve_ * std::min(kSpareOfSize * (field_.ball_radius_m(solid) + least), kSpareOfScale * scale_m_);
}

void TautString::set_times(const std::vector<Vec3>& chain) {
  times_s_.assign(chain.size(), start_time_s_);
  if (!field_.anything_moves()) return;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const Vec3 d = chain[i] - chain[i - 1];
    const double climb = d.z() > 0.0 ? d.z() / limits_.climb_speed_mps : -d.z() / limits_.descent_speed_mps;
    times_s_[i] = times_s_[i - 1] + std::max(climb, d.norm() / limits_.cruise_speed_mps);
  }
}

/// Keeps the multiplier of a contact that there was before; both lists are in the same order.
TautString::Contact& TautString::add(std::size_t hop, int solid, double required, std::size_t& old) {
  const auto earlier = [&](const Contact& c) { return c.hop < hop || (c.hop == hop && c.solid < solid); };
  while (old < before_.size() && earlier(before_[old])) ++old;
  const bool known = old < before_.size() && before_[old].hop == hop && before_[old].solid == solid;
  contacts_.push_back({hop, solid, required, 0.0, known ? before_[old].multiplier : 0.0, 0.0, 0.0});
  return contacts_.back();
}

void TautString::collect_ground(const Vec3& a, const Vec3& b, std::size_t hop, std::size_t& old) {
  const Terrain& terrain = field_.world().terrain();
  const auto box_top_m = [&](const Vec3& p, const Vec3& q) {
    const Vec2 lo = p.cwiseMin(q).head<2>().array() - near_m_;
    const Vec2 hi = p.cwiseMax(q).head<2>().array() + near_m_;
    return terrain.max_in(lo, hi);
  };
  if (std::min(a.z(), b.z()) - box_top_m(a, b) > near_m_ + 2.0 * field_.ground_clearance_m()) return;
  const int pieces = terrain.is_flat() ? kFlatPieces : kGroundPieces;
  for (int piece = pieces; piece-- > 0;) {
    const double from = static_cast<double>(piece) / pieces;
    const double to = static_cast<double>(piece + 1) / pieces;
    const GroundContact low = lowest_over(terrain, a, b, from, to);
    const Vec3 lowest = a + low.fraction * (b - a);
    const double keep = std::max(height_to_keep_m(terrain, lowest.head<2>(), limits_.clearance_m()),
                                 field_.ground_clearance_m());
    const double required = ground_factor_ * keep + reserve_ * kSpareOfScale * scale_m_;
    const double lean = std::sqrt(1.0 + low.slope.squaredNorm());
    if (low.height_m > required + lean * near_m_) continue;
    add(hop, -1 - piece, required, old).ground_top_m = box_top_m(a + from * (b - a), a + to * (b - a));
  }
}

void TautString::collect(const std::vector<Vec3>& chain) {
  std::swap(before_, contacts_);
  contacts_.clear();
  std::size_t old = 0;
  for (std::size_t hop = 0; hop + 1 < chain.size(); ++hop) {
    const Vec3& a = chain[hop];
    const Vec3& b = chain[hop + 1];
    collect_ground(a, b, hop, old);
    for (const std::uint32_t i : nearby_.along(a, b, near_m_)) {
      if (!field_.near(i, a, times_s_[hop], b, times_s_[hop + 1], near_m_)) continue;
      add(hop, static_cast<int>(i), required_m(i), old);
    }
  }
}

/// Block (a, b) of the second derivatives; points are counted without the fixed ends.
void TautString::add_block(std::size_t a, std::size_t b, const Mat3& block) {
  const std::size_t last = there_.hessian.size();
  if (a == 0 || b == 0 || a > last || b > last) return;
  (a == b ? there_.hessian.diagonal : there_.hessian.beyond)[a - 1] += block;
}

double TautString::hop_length(const Vec3& d, std::size_t hop) {
  const double soft = kSoft * scale_m_;
  const double level = soft_norm(d.x() * d.x() + d.y() * d.y(), soft);
  const double rise = std::abs(d.z());
  const bool steep = rise > steepest_ * level;
  const double whole = soft_norm(d.squaredNorm(), soft);
  const double excess = steep ? std::sqrt(1.0 + steepest_ * steepest_) - steepest_ : 0.0;
  Vec3 g = d / whole;
  Mat3 h = (Mat3::Identity() - g * g.transpose()) / (whole * scale_m_);
  if (steep) {
    const Vec3 u(d.x() / level, d.y() / level, 0.0);
    g = excess * u + Vec3(0.0, 0.0, d.z() < 0.0 ? -1.0 : 1.0);
    h = (Mat3(Vec3(1.0, 1.0, 0.0).asDiagonal()) - u * u.transpose()) * (excess / (level * scale_m_));
  }
  there_.gradient[hop] -= g / scale_m_;
  there_.gradient[hop + 1] += g / scale_m_;
  add_block(hop, hop, h);
  add_block(hop + 1, hop + 1, h);
  add_block(hop, hop + 1, -h);
  return (steep ? rise + excess * level : whole) / scale_m_;
}

/// Gradient and second derivatives of the penalty of one contact; `force` is minus its derivative by the
/// slack.
void TautString::push(const std::vector<Vec3>& chain, const Contact& c, const Approach& approach,
                      double force) {
  const std::size_t hop = c.hop;
  const double beta = approach.fraction;
  const double alpha = 1.0 - beta;
  const Vec3& n = approach.normal;
  const double pull = force / scale_m_;
  there_.gradient[hop] -= (pull * alpha) * n;
  there_.gradient[hop + 1] -= (pull * beta) * n;
  const Mat3 nn = (weight_ / (scale_m_ * scale_m_)) * n * n.transpose();
  Mat3 aa = alpha * alpha * nn;
  Mat3 ab = alpha * beta * nn;
  Mat3 bb = beta * beta * nn;
  if (c.solid >= 0 && is_sphere(field_, static_cast<std::size_t>(c.solid))) {
    const auto solid = static_cast<std::size_t>(c.solid);
    const double reach = std::max(approach.signed_distance_m + field_.ball_radius_m(solid),
                                  1e-3 * field_.ball_radius_m(solid));
    const Mat3 bend = (pull / reach) * (Mat3::Identity() - n * n.transpose());
    aa -= alpha * alpha * bend;
    ab -= alpha * beta * bend;
    bb -= beta * beta * bend;
    const Vec3 e = chain[hop + 1] - chain[hop];
    const double square = e.squaredNorm();
    if (beta > 0.0 && beta < 1.0 && square > 0.0) {
      const Vec3 v = (alpha / reach) * e - n;
      const Vec3 u = (beta / reach) * e + n;
      const double slide = pull * reach / square;
      aa += slide * v * v.transpose();
      ab += slide * v * u.transpose();
      bb += slide * u * u.transpose();
    }
  }
  add_block(hop, hop, aa);
  add_block(hop + 1, hop + 1, bb);
  add_block(hop, hop + 1, ab);
}

/// False where the ground is farther than that.
bool TautString::approach_ground(const Vec3& a, const Vec3& b, const Contact& c, double cap_m,
                                 Approach& approach) const {
  const Terrain& terrain = field_.world().terrain();
  const double pieces = terrain.is_flat() ? kFlatPieces : kGroundPieces;
  const double piece = -1 - c.solid;
  const double from = piece / pieces;
  const double to = (piece + 1.0) / pieces;
  const double lowest_z = a.z() + (b.z() < a.z() ? to : from) * (b.z() - a.z());
  if (lowest_z - c.ground_top_m > c.required_m + cap_m) return false;
  const GroundContact low = lowest_over(terrain, a, b, from, to);
  // Height is no distance: its gradient is longer than 1. The slack is taken as the height over it.
  approach.normal = Vec3(-low.slope.x(), -low.slope.y(), 1.0);
  const double lean = approach.normal.norm();
  approach.normal /= lean;
  approach.signed_distance_m = (low.height_m - c.required_m) / lean + c.required_m;
  approach.fraction = low.fraction;
  return true;
}

double TautString::contact(const std::vector<Vec3>& chain, Contact& c) {
  const Vec3& a = chain[c.hop];
  const Vec3& b = chain[c.hop + 1];
  const double spent = 0.5 * c.multiplier * c.multiplier / weight_;
  // Beyond this slack it exerts no force.
  const double free = c.multiplier / weight_;
  c.slack = free;
  Approach approach;
  if (c.solid >= 0) {
    const auto solid = static_cast<std::size_t>(c.solid);
    const double t0_s = times_s_[c.hop];
    const double t1_s = times_s_[c.hop + 1];
    const double more_m = free * scale_m_ + c.required_m - field_.required_m(solid);
    if (!field_.near(solid, a, t0_s, b, t1_s, more_m)) return -spent;
    approach = field_.approach(solid, a, t0_s, b, t1_s);
  } else if (!approach_ground(a, b, c, 4.0 * free * scale_m_, approach)) {
    return -spent;
  }
  c.fraction = approach.fraction;
  c.slack = (approach.signed_distance_m - c.required_m) / scale_m_;
  const double force = c.multiplier - weight_ * c.slack;
  if (force <= 0.0) return -spent;
  push(chain, c, approach, force);
  return 0.5 * force * force / weight_ - spent;
}

double TautString::evaluate(const std::vector<Vec3>& chain) {
  ++evaluations_;
  set_times(chain);
  for (Vec3& g : there_.gradient) g.setZero();
  there_.hessian.set_zero();
  double value = 0.0;
  for (std::size_t hop = 0; hop + 1 < chain.size(); ++hop)
    value += hop_length(chain[hop + 1] - chain[hop], hop);
  for (Contact& c : contacts_) value += contact(chain, c);
  return value;
}

/// A coordinate at its bound that is pushed outwards stays.
void TautString::hold_at_bounds(const std::vector<Vec3>& chain) {
  const Bounds& bounds = field_.world().bounds();
  for (std::size_t i = 0; i < here_.hessian.size(); ++i) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double at = chain[i + 1][axis];
      const bool low = at <= bounds.min_m[axis] && right_[i][axis] < 0.0;
      const bool high = at >= bounds.max_m[axis] && right_[i][axis] > 0.0;
      if (!low && !high) continue;
      right_[i][axis] = 0.0;
      here_.hessian.diagonal[i].row(axis).setZero();
      here_.hessian.diagonal[i].col(axis).setZero();
      here_.hessian.diagonal[i](axis, axis) = 1.0 / (scale_m_ * scale_m_);
      here_.hessian.beyond[i].row(axis).setZero();
      if (i > 0) here_.hessian.beyond[i - 1].col(axis).setZero();
    }
  }
}

void TautString::minimise(std::vector<Vec3>& chain, int steps, std::uint64_t max_evaluations) {
  const Bounds& bounds = field_.world().bounds();
  const double unit = 1.0 / (scale_m_ * scale_m_);
  double damping = 1e-3 * unit;
  double value = evaluate(chain);
  std::swap(here_, there_);
  for (int k = 0; k < steps && evaluations_ < max_evaluations; ++k) {
    for (std::size_t i = 0; i < right_.size(); ++i) right_[i] = -here_.gradient[i + 1];
    hold_at_bounds(chain);
    bool moved = false;
    double gain = 0.0;
    for (int tries = 0; tries < 12 && evaluations_ < max_evaluations; ++tries) {
      if (!here_.hessian.solve(damping, right_, step_)) {
        damping = std::max(8.0 * damping, 0.1 * unit);
        continue;
      }
      double longest = 0.0;
      for (const Vec3& s : step_) longest = std::max(longest, s.squaredNorm());
      longest = std::sqrt(longest);
      const double share = longest > kLongestStep * near_m_ ? kLongestStep * near_m_ / longest : 1.0;
      for (std::size_t i = 0; i < step_.size(); ++i) {
        trial_[i + 1] = (chain[i + 1] + share * step_[i]).cwiseMax(bounds.min_m).cwiseMin(bounds.max_m);
      }
      const double next = evaluate(trial_);
      if (next < value) {
        gain = value - next;
        value = next;
        moved = true;
        damping *= 0.2;
        break;
      }
      damping = std::max(8.0 * damping, 0.1 * unit);
      if (longest < 1e-7 * scale_m_) break;
    }
    if (!moved) return;
    std::swap(chain, trial_);
    std::swap(here_, there_);
    if (gain <= kEnough) return;
  }
}

TautResult TautString::tighten(std::vector<Vec3>& chain, double start_time_s, std::uint64_t max_evaluations,
                               double longest_m, const TautParams& params) {
  start_time_s_ = start_time_s;
  evaluations_ = 0;
  double way_m = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) way_m += (chain[i] - chain[i - 1]).norm();
  const double mean_m = way_m / static_cast<double>(chain.size() - 1);
  scale_m_ = std::min(distance_m_, kMeanHops * mean_m);
  near_m_ = std::min(kNearOfScale * distance_m_, kNearOfHop * mean_m);
  contacts_.clear();
  here_.resize(chain.size());
  there_.resize(chain.size());
  trial_ = chain;
  const std::size_t inner = chain.size() - 2;
  right_.resize(inner);
  step_.resize(inner);
  weight_ = params.first_weight;
  double violation = 0.0;
  for (int round = 0; round < params.rounds; ++round) {
    set_times(chain);
    collect(chain);
    if (inner > 0) minimise(chain, params.steps_per_round, max_evaluations);
    evaluate(chain);
    violation = 0.0;
    double change = 0.0;
    for (Contact& c : contacts_) {
      violation = std::max(violation, -c.slack);
      const double next = std::max(0.0, c.multiplier - weight_ * c.slack);
      change = std::max(change, std::abs(next - c.multiplier) / weight_);
      c.multiplier = next;
    }
    if (evaluations_ >= max_evaluations) break;
    // What still cuts corners only gets longer.
    if (flown_length_m(chain, steepest_) > longest_m * (round == 0 ? 1.005 : 1.001))
      return {flown_length_m(chain, steepest_), violation * scale_m_, evaluations_, true};
    if (round > 0 && violation < 0.3 * kSpareOfScale && change < 1e-5) break;
    weight_ *= params.growth;
  }
  return {flown_length_m(chain, steepest_), violation * scale_m_, evaluations_, false};
}

bool TautString::refine(std::vector<Vec3>& chain, double least_gain_m, std::size_t most_points) {
  constexpr double kStraight = 1e-4;
  refined_.clear();
  refined_.push_back(chain.front());
  bool changed = false;
  std::size_t left = most_points > chain.size() ? most_points - chain.size() : 0;
  std::size_t c = 0;
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
    const Vec3 before = chain[i] - chain[i - 1];
    const Vec3 after = chain[i + 1] - chain[i];
    const double turn = std::atan2(before.cross(after).norm(), before.dot(after));
    const bool together = before.norm() < 1e-5 * scale_m_;
    if (turn < kStraight || together) {
      changed = true;
      continue;
    }
    // Where the hops on both sides touch last and first.
    double touches = -1.0;
    double leaves = -1.0;
    for (; c < contacts_.size() && contacts_[c].hop < i - 1; ++c) {
    }
    for (std::size_t k = c; k < contacts_.size() && contacts_[k].hop <= i; ++k) {
      if (contacts_[k].multiplier <= 0.0) continue;
      if (contacts_[k].hop == i - 1) touches = std::max(touches, contacts_[k].fraction);
      if (contacts_[k].hop == i)
        leaves = leaves < 0.0 ? contacts_[k].fraction : std::min(leaves, contacts_[k].fraction);
    }
    const double tangent = touches < 0.0 || leaves < 0.0
                               ? 0.0
                               : std::min((1.0 - touches) * before.norm(), leaves * after.norm());
    const double radius = tangent / std::tan(0.5 * turn);
    const double gain = radius * (2.0 * std::tan(0.5 * turn) - 4.0 * std::tan(0.25 * turn));
    if (!(gain > least_gain_m) || left == 0) {
      refined_.push_back(chain[i]);
      continue;
    }
    --left;
    changed = true;
    // The two corners of a polygon round the same arc.
    const double back = tangent - radius * std::tan(0.25 * turn);
    refined_.push_back(chain[i] - back * before.normalized());
    refined_.push_back(chain[i] + back * after.normalized());
  }
  refined_.push_back(chain.back());
  if (changed) chain = refined_;
  return changed;
}

}  // namespace swallowtail::planner
