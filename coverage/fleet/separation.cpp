#include "coverage/fleet/separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::coverage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kStep_s = 1.0;
/// Just touching is no conflict.
constexpr double kTouch_s = 1e-7;

struct Times {
  double from_s = -kInfinity;
  double to_s = kInfinity;
};

Times meet(const Times& a, const Times& b) {
  return {std::max(a.from_s, b.from_s), std::min(a.to_s, b.to_s)};
}

/// When |offset + velocity · t| is below a distance.
Times near_times(const Vec2& offset, const Vec2& velocity, double distance) {
  const double a = velocity.squaredNorm();
  const double b = offset.dot(velocity);
  const double c = offset.squaredNorm() - distance * distance;
  if (a < 1e-12) return c < 0.0 ? Times{} : Times{kInfinity, -kInfinity};
  const double root = b * b - a * c;
  if (root <= 0.0) return {kInfinity, -kInfinity};
  return {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a};
}

Vec3 velocity_of(const TimedPiece& piece) {
  const double duration = piece.end_s - piece.start_s;
  if (!std::isfinite(duration) || duration < 1e-12) return Vec3::Zero();
  return (piece.to_m - piece.from_m) / duration;
}

double level_m(const TimedPiece& a, const TimedPiece& b, const Separation& separation) {
  return a.is_landed || b.is_landed ? separation.landed_m : separation.horizontal_m;
}

bool boxes_meet(const TimedPiece& a, const TimedPiece& b, const Separation& separation) {
  const double apart_m = level_m(a, b, separation);
  const Vec3 reach(apart_m, apart_m, separation.vertical_m);
  return ((a.from_m.cwiseMax(a.to_m) + reach - b.from_m.cwiseMin(b.to_m)).array() > 0.0).all() &&
         ((b.from_m.cwiseMax(b.to_m) + reach - a.from_m.cwiseMin(a.to_m)).array() > 0.0).all();
}

/// Everything that a team takes up, in the order of the stretches; the last stands for good.
std::vector<TimedPiece> pieces_of(const Trace& trace) {
  std::vector<TimedPiece> out;
  for (const Stretch& stretch : trace.stretches) {
    for (const Vec3& stand : stretch.stands_m)
      out.push_back({stand, stand, stretch.stands_from_s, stretch.take_off_s, true});
    out.insert(out.end(), stretch.pieces.begin(), stretch.pieces.end());
  }
  out.push_back({trace.end_m, trace.end_m, trace.end_s, kInfinity, true});
  return out;
}

/// A piece of the mover, and what of the others comes near its place at any time.
struct Watched {
  TimedPiece own;
  std::vector<TimedPiece> others;
};

class Yielding {
 public:
  Yielding(const Trace& mover, std::span<const Trace> others, const Separation& separation, double most_s)
      : mover_(mover),
        separation_(separation),
        steps_(static_cast<std::size_t>(std::ceil(most_s / kStep_s)) + 1),
        shifts_(mover.stretches.size(), 0),
        failed_(mover.stretches.size() + 1, std::vector<char>(steps_, 0)) {
    std::vector<TimedPiece> all;
    for (const Trace& other : others) {
      const std::vector<TimedPiece> pieces = pieces_of(other);
      all.insert(all.end(), pieces.begin(), pieces.end());
    }
    for (const Stretch& stretch : mover.stretches) {
      stands_.emplace_back();
      for (const Vec3& stand : stretch.stands_m)
        watch({stand, stand, stretch.stands_from_s, stretch.take_off_s, true}, all, stands_.back());
      flights_.emplace_back();
      for (const TimedPiece& piece : stretch.pieces) watch(piece, all, flights_.back());
    }
    watch({mover.end_m, mover.end_m, mover.end_s, kInfinity, true}, all, end_);
  }

  std::optional<std::vector<double>> run() {
    if (!place(0, 0)) return std::nullopt;
    std::vector<double> out;
    for (const std::size_t shift : shifts_) out.push_back(kStep_s * static_cast<double>(shift));
    return out;
  }

 private:
  void watch(const TimedPiece& own, const std::vector<TimedPiece>& all, std::vector<Watched>& to) const {
    Watched watched{own, {}};
    for (const TimedPiece& other : all) {
      if (boxes_meet(own, other, separation_)) watched.others.push_back(other);
    }
    if (!watched.others.empty()) to.push_back(std::move(watched));
  }
  bool is_clear(const std::vector<Watched>& all, double shift_s, double longer_s) const {
    for (const Watched& watched : all) {
      TimedPiece own = watched.own;
      own.end_s += longer_s;
      for (const TimedPiece& other : watched.others) {
        if (conflict(own, shift_s, other, separation_)) return false;
      }
    }
    return true;
  }

  /// Stretches from `k` on, the one before `before` steps late.
  bool place(std::size_t k, std::size_t before) {
    if (failed_[k][before] != 0) return false;
    const double before_s = kStep_s * static_cast<double>(before);
    if (k == shifts_.size()) {
      if (is_clear(end_, before_s, 0.0)) return true;
      failed_[k][before] = 1;
      return false;
    }
    for (std::size_t shift = before; shift < steps_; ++shift) {
      const double shift_s = kStep_s * static_cast<double>(shift);
      if (!is_clear(stands_[k], before_s, shift_s - before_s)) break;
      if (!is_clear(flights_[k], shift_s, 0.0) || !place(k + 1, shift)) continue;
      shifts_[k] = shift;
      return true;
    }
    failed_[k][before] = 1;
    return false;
  }

  const Trace& mover_;
  const Separation& separation_;
  std::size_t steps_;
  std::vector<std::size_t> shifts_;
  std::vector<std::vector<char>> failed_;
  std::vector<std::vector<Watched>> stands_;
  std::vector<std::vector<Watched>> flights_;
  std::vector<Watched> end_;
};

}  // namespace

bool conflict(const TimedPiece& a, double shift_s, const TimedPiece& b, const Separation& separation) {
  const Times both = meet({a.start_s + shift_s, a.end_s + shift_s}, {b.start_s, b.end_s});
  if (!(both.to_s - both.from_s > kTouch_s)) return false;
  const Vec3 velocity_a = velocity_of(a);
  const Vec3 velocity_b = velocity_of(b);
  // Times from `both.from_s` on.
  const Vec3 offset = a.from_m + velocity_a * (both.from_s - a.start_s - shift_s) - b.from_m -
                      velocity_b * (both.from_s - b.start_s);
  const Vec3 velocity = velocity_a - velocity_b;
  const Times level = near_times(offset.head<2>(), velocity.head<2>(), level_m(a, b, separation));
  const Times upright = near_times(Vec2(offset.z(), 0.0), Vec2(velocity.z(), 0.0), separation.vertical_m);
  const Times close = meet(meet(level, upright), {0.0, both.to_s - both.from_s});
  return close.to_s - close.from_s > kTouch_s;
}

bool conflict(const Trace& a, const Trace& b, const Separation& separation) {
  const std::vector<TimedPiece> of_b = pieces_of(b);
  for (const TimedPiece& one : pieces_of(a)) {
    for (const TimedPiece& other : of_b) {
      if (boxes_meet(one, other, separation) && conflict(one, 0.0, other, separation)) return true;
    }
  }
  return false;
}

std::optional<std::vector<double>> delays_of(const Trace& mover, std::span<const Trace> others,
                                             const Separation& separation, double most_s) {
  return Yielding(mover, others, separation, most_s).run();
}

void delay(Plan& plan, const Trace& trace, std::span<const double> delays_s) {
  for (std::size_t i = 0; i < plan.legs.size(); ++i) {
    plan.legs[i].start_s += delays_s[trace.stretch_of_leg[i]];
    plan.legs[i].end_s += delays_s[trace.stretch_of_leg[i]];
  }
  for (std::size_t i = 0; i < plan.rendezvous.size(); ++i) {
    Rendezvous& meeting = plan.rendezvous[i];
    meeting.robot_arrives_s += delays_s[i];
    meeting.land_s += delays_s[i];
    meeting.arrive_by_s += delays_s[i];
    meeting.depart_s += delays_s[i + 1];
  }
  for (DepotVisit& visit : plan.depot_visits) {
    visit.arrives_s += delays_s[visit.before];
    visit.leaves_s += delays_s[visit.before];
  }
  if (plan.robot_home_s > 0.0) plan.robot_home_s += delays_s.back();
  plan.take_off_s += delays_s.front();
  plan.makespan_s += delays_s.back();
  plan.cost = plan.makespan_s;
}

}  // namespace swallowtail::coverage
