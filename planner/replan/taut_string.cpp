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
void TautString::add(std::size_t hop, int solid, double required, std::size_t& old) {
  const auto earlier = [&](const Contact& c) { return c.hop < hop || (c.hop == hop && c.solid < solid); };
  while (old < before_.size() && earlier(before_[old])) ++old;
  const bool known = old < before_.size() && before_[old].hop == hop && before_[old].solid == solid;
  contacts_.push_back({hop, solid, required, known ? before_[old].multiplier : 0.0, 0.0, 0.0});
}

void TautString::collect(const std::vector<Vec3>& chain) {
  std::swap(before_, contacts_);
  contacts_.clear();
  std::size_t old = 0;
  const Terrain& terrain = field_.world().terrain();
  const double cap_m = near_m_;
  for (std::size_t hop = 0; hop + 1 < chain.size(); ++hop) {
    const Vec3& a = chain[hop];
    const Vec3& b = chain[hop + 1];
    const Vec2 lo = a.cwiseMin(b).head<2>().array() - cap_m;
    const Vec2 hi = a.cwiseMax(b).head<2>().array() + cap_m;
    if (std::min(a.z(), b.z()) - terrain.max_in(lo, hi) < cap_m + 2.0 * field_.ground_clearance_m()) {
      const int pieces = terrain.is_flat() ? 2 : kGroundPieces;
      for (int piece = pieces; piece-- > 0;) {
        const GroundContact low = lowest_over(terrain, a, b, static_cast<double>(piece) / pieces,
                                              static_cast<double>(piece + 1) / pieces);
        const double lean = std::sqrt(1.0 + low.slope.squaredNorm());
        const double required =
            ground_factor_ * std::max(limits_.clearance_m() * lean, field_.ground_clearance_m()) +
            reserve_ * kSpareOfScale * scale_m_;
        if (low.height_m < required + lean * cap_m) add(hop, -1 - piece, required, old);
      }
    }
    for (const std::uint32_t i : nearby_.along(a, b, cap_m)) {
      if (!field_.near(i, a, times_s_[hop], b, times_s_[hop + 1], cap_m)) continue;
      add(hop, static_cast<int>(i), required_m(i), old);
    }
  }
}

/// Block (a, b) of the second derivatives; points are counted without the fixed ends.
void TautString::add_block(std::size_t a, std::size_t b, const Mat3& block) {
  const std::size_t last = hessian_.size();
  if (a == 0 || b == 0 || a > last || b > last) return;
  (a == b ? hessian_.diagonal : hessian_.beyond)[a - 1] += block;
}

double TautString::hop_length(const Vec3& d, std::size_t hop, bool with_derivatives) {
  const double soft = kSoft * scale_m_;
  const double level = soft_norm(d.x() * d.x() + d.y() * d.y(), soft);
  const double rise = std::abs(d.z());
  const bool steep = rise > steepest_ * level;
  const double whole = soft_norm(d.squaredNorm(), soft);
  const double excess = steep ? std::sqrt(1.0 + steepest_ * steepest_) - steepest_ : 0.0;
  if (with_derivatives) {
    Vec3 g = d / whole;
    Mat3 h = (Mat3::Identity() - g * g.transpose()) / (whole * scale_m_);
    if (steep) {
      const Vec3 u(d.x() / level, d.y() / level, 0.0);
      g = excess * u + Vec3(0.0, 0.0, d.z() < 0.0 ? -1.0 : 1.0);
      h = (Mat3(Vec3(1.0, 1.0, 0.0).asDiagonal()) - u * u.transpose()) * (excess / (level * scale_m_));
    }
    gradient_[hop] -= g / scale_m_;
    gradient_[hop + 1] += g / scale_m_;
    add_block(hop, hop, h);
    add_block(hop + 1, hop + 1, h);
    add_block(hop, hop + 1, -h);
  }
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
  gradient_[hop] -= (pull * alpha) * n;
  gradient_[hop + 1] -= (pull * beta) * n;
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

double TautString::contact(const std::vector<Vec3>& chain, Contact& c, bool with_derivatives) {
  const Vec3& a = chain[c.hop];
  const Vec3& b = chain[c.hop + 1];
  Approach approach;
  double lean = 1.0;
  if (c.solid >= 0) {
    approach = field_.approach(static_cast<std::size_t>(c.solid), a, times_s_[c.hop], b, times_s_[c.hop + 1]);
  } else {
    const Terrain& terrain = field_.world().terrain();
    const double pieces = terrain.is_flat() ? 2.0 : kGroundPieces;
    const double piece = -1 - c.solid;
    const GroundContact low = lowest_over(terrain, a, b, piece / pieces, (piece + 1.0) / pieces);
    // Height is no distance: its gradient is longer than 1. The slack is taken as the height over it.
    approach.normal = Vec3(-low.slope.x(), -low.slope.y(), 1.0);
    lean = approach.normal.norm();
    approach.normal /= lean;
    approach.signed_distance_m = (low.height_m - c.required_m) / lean + c.required_m;
    approach.fraction = low.fraction;
  }
  c.fraction = approach.fraction;
  c.slack = (approach.signed_distance_m - c.required_m) / scale_m_;
  const double force = c.multiplier - weight_ * c.slack;
  const double spent = 0.5 * c.multiplier * c.multiplier / weight_;
  if (force <= 0.0) return -spent;
  if (with_derivatives) push(chain, c, approach, force);
  return 0.5 * force * force / weight_ - spent;
}

double TautString::evaluate(const std::vector<Vec3>& chain, bool with_derivatives) {
  ++evaluations_;
  set_times(chain);
  if (with_derivatives) {
    for (Vec3& g : gradient_) g.setZero();
    hessian_.set_zero();
  }
  double value = 0.0;
  for (std::size_t hop = 0; hop + 1 < chain.size(); ++hop) {
    value += hop_length(chain[hop + 1] - chain[hop], hop, with_derivatives);
  }
  for (Contact& c : contacts_) value += contact(chain, c, with_derivatives);
  return value;
}

/// A coordinate at its bound that is pushed outwards stays.
void TautString::hold_at_bounds(const std::vector<Vec3>& chain) {
  const Bounds& bounds = field_.world().bounds();
  for (std::size_t i = 0; i < hessian_.size(); ++i) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double at = chain[i + 1][axis];
      const bool low = at <= bounds.min_m[axis] && right_[i][axis] < 0.0;
      const bool high = at >= bounds.max_m[axis] && right_[i][axis] > 0.0;
      if (!low && !high) continue;
      right_[i][axis] = 0.0;
      hessian_.diagonal[i].row(axis).setZero();
      hessian_.diagonal[i].col(axis).setZero();
      hessian_.diagonal[i](axis, axis) = 1.0 / (scale_m_ * scale_m_);
      hessian_.beyond[i].row(axis).setZero();
      if (i > 0) hessian_.beyond[i - 1].col(axis).setZero();
    }
  }
}

void TautString::minimise(std::vector<Vec3>& chain, int steps, std::uint64_t max_evaluations) {
  const Bounds& bounds = field_.world().bounds();
  const double unit = 1.0 / (scale_m_ * scale_m_);
  double damping = 1e-3 * unit;
  double value = evaluate(chain, true);
  for (int k = 0; k < steps && evaluations_ < max_evaluations; ++k) {
    for (std::size_t i = 0; i < right_.size(); ++i) right_[i] = -gradient_[i + 1];
    hold_at_bounds(chain);
    bool moved = false;
    double gain = 0.0;
    for (int tries = 0; tries < 12 && evaluations_ < max_evaluations; ++tries) {
      if (!hessian_.solve(damping, right_, step_)) {
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
      const double next = evaluate(trial_, false);
      if (next < value) {
        gain = value - next;
        moved = true;
        damping *= 0.2;
        break;
      }
      damping = std::max(8.0 * damping, 0.1 * unit);
      if (longest < 1e-7 * scale_m_) break;
    }
    if (!moved) return;
    std::swap(chain, trial_);
    if (gain <= kEnough) return;
    value = evaluate(chain, true);
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
  gradient_.resize(chain.size());
  trial_ = chain;
  const std::size_t inner = chain.size() - 2;
  right_.resize(inner);
  step_.resize(inner);
  hessian_.resize(inner);
  weight_ = params.first_weight;
  double violation = 0.0;
  for (int round = 0; round < params.rounds; ++round) {
    set_times(chain);
    collect(chain);
    if (inner > 0) minimise(chain, params.steps_per_round, max_evaluations);
    evaluate(chain, false);
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
