#include "tests/property/coverage/tiny_mission.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace swallowtail::coverage::test {
namespace {

constexpr double kStep_s = 0.1;

struct Target {
  Vec3 at;
  std::size_t leg;
  bool cover;
  bool ends_leg;
  double stop_s;  ///< stands still there
};

class TinyMission {
 public:
  TinyMission(PlanKeeper& keeper, const MissionWeather& weather, std::uint64_t seed)
      : keeper_(keeper),
        weather_(weather),
        rng_(seed),
        task_(keeper.task()),
        position_(task_.start_m),
        robot_(task_.charger.start_m),
        energy_(task_.battery.capacity) {
    position_.z() = 0.0;
    robot_.z() = 0.0;
    remember();
  }

  MissionLog run(double most_s) {
    plan_route();
    while (time_ < most_s && !over()) step();
    log_.completed = over() && keeper_.complete();
    log_.time_s = time_;
    return log_;
  }

 private:
  bool over() const {
    return !flying_ && !docked_ && legs_done_ == keeper_.plan().legs.size() && has_flown_ &&
           keeper_.complete() && rest_s_ > 3.0;
  }

  void remember() {
    prefix_ = keeper_.plan().legs;
    done_before_ = legs_done_;
  }
  /// Told as done it never changes; of one that is done since then a part may be left.
  bool is_kept(std::size_t leg) const {
    const Leg& before = prefix_[leg];
    const Leg& now = keeper_.plan().legs[leg];
    if (leg < done_before_) return now.entry_m == before.entry_m && now.exit_m == before.exit_m;
    const Vec3 way = before.exit_m - before.entry_m;
    return std::ranges::all_of(std::array{now.entry_m, now.exit_m}, [&](const Vec3& end) {
      const double share =
          way.squaredNorm() > 0.0 ? (end - before.entry_m).dot(way) / way.squaredNorm() : 0.0;
      return share > -1e-9 && share < 1.0 + 1e-9 && (before.entry_m + share * way - end).norm() < 1e-6;
    });
  }
  void news(bool changed) {
    if (!changed) return;
    ++log_.revisions;
    log_.reasons.push_back(keeper_.plan().reason);
    for (std::size_t i = 0; i < legs_done_; ++i) {
      if (i >= keeper_.plan().legs.size() || !is_kept(i))
        log_.faults.push_back("flown leg " + std::to_string(i) + " changed");
    }
    remember();
    if (flying_) plan_route();
  }

  void go(const Vec3& to, std::size_t leg, bool cover, bool ends, double stop = 0.0) {
    route_.push_back({to, leg, cover, ends, stop});
  }
  void land_below(const Vec3& at, std::size_t leg) {
    go(at, leg, false, false, 1.0);
    go(Vec3(at.x(), at.y(), 0.0), leg, false, false);
  }
  /// Up first, level, down last.
  void hop(Vec3 from, const Vec3& to, std::size_t leg) {
    const double z = std::max(from.z(), to.z());
    if (z > from.z() + 1e-6) go(Vec3(from.x(), from.y(), z), leg, false, false, 1.0);
    go(Vec3(to.x(), to.y(), z), leg, false, false, 1.0);
    if (z > to.z() + 1e-6) go(to, leg, false, false, 1.0);
  }

  enum class From { kGround, kAir };
  void plan_route(From from = From::kAir) {
    route_.clear();
    const LivePlan& plan = keeper_.plan();
    Vec3 at = position_;
    // A planned landing at an entry that was not reached yet.
    if (from == From::kAir && flying_ && legs_done_ > 0 && !plan.rendezvous.empty() &&
        plan.rendezvous.front().id == entry_id(legs_done_) && legs_done_ < plan.legs.size()) {
      hop(at, plan.legs[legs_done_].entry_m, legs_done_);
      land_below(plan.legs[legs_done_].entry_m, legs_done_);
      return;
    }
    if (from == From::kAir && flying_ && legs_done_ > 0 && !plan.rendezvous.empty() &&
        plan.rendezvous.front().id == exit_id(legs_done_ - 1)) {
      land_below(at, legs_done_ - 1);
      return;
    }
    for (std::size_t i = legs_done_; i < plan.legs.size(); ++i) {
      const Leg& leg = plan.legs[i];
      const Vec3 way = leg.exit_m - leg.entry_m;
      const double s = way.norm() < 1e-9 ? 0.0 : (position_ - leg.entry_m).dot(way) / way.norm();
      const bool on_it = i == legs_done_ && covering_ && way.norm() > 1e-9 && s > 0.0 && s < way.norm() &&
                         (position_ - leg.entry_m - way.normalized() * s).norm() < 0.3;
      if (!on_it) hop(at, leg.entry_m, i);
      go(leg.exit_m, i, leg.kind == LegKind::kCover, true);
      at = leg.exit_m;
      if (leg.transfer == Transfer::kFF) continue;
      if (leg.transfer == Transfer::kFFDU && i + 1 < plan.legs.size()) {
        hop(at, plan.legs[i + 1].entry_m, i + 1);
        at = plan.legs[i + 1].entry_m;
      }
      land_below(at, i);
      return;
    }
    land_below(at, plan.legs.empty() ? 0 : plan.legs.size() - 1);
  }

  void fly_step() {
    double left = kStep_s;
    const Vec3 before = position_;
    while (left > 1e-9 && !route_.empty()) {
      Target& target = route_.front();
      const Vec3 way = target.at - position_;
      const bool vertical = way.head<2>().norm() < 1e-6;
      const double speed =
          vertical ? (way.z() > 0.0 ? task_.vehicle.climb_speed_mps : task_.vehicle.descent_speed_mps)
                   : task_.vehicle.cruise_speed_mps;
      const double needs = way.norm() / speed;
      if (needs > left) {
        position_ += way * (left / needs);
        left = 0.0;
        covering_ = target.cover;
        leg_ = target.leg;
        break;
      }
      position_ = target.at;
      left -= needs;
      covering_ = target.cover;
      leg_ = target.leg;
      if (target.stop_s > 0.0) {
        const double waits = std::min(left, target.stop_s);
        target.stop_s -= waits;
        left -= waits;
        if (target.stop_s > 1e-9) break;
      }
      if (target.ends_leg) {
        legs_done_ = target.leg + 1;
        covering_ = false;
      }
      route_.pop_front();
    }
    velocity_ = (position_ - before) / kStep_s;
    energy_ -= kStep_s * weather_.bias * (1.0 + weather_.noise * gust_);
    if (route_.empty()) {
      flying_ = false;
      rest_s_ = 0.0;
    }
  }

  void robot_step() {
    const auto& meetings = keeper_.plan().rendezvous;
    if (docked_) {
      // Driving and charging at once, then the handling of the take-off.
      const Rendezvous meeting = meetings.empty() ? meeting_ : meetings.front();
      if (handling_s_ > 0.0) {
        handling_s_ -= kStep_s;
        return;
      }
      const Vec3 to = meeting.carry ? meeting.carry_to_m : robot_;
      drive(to);
      position_ = robot_;
      const bool there = (robot_ - to).head<2>().norm() < 0.01;
      if (energy_ < meeting.charge_to - 1e-9) {
        energy_ = std::min(meeting.charge_to, energy_ + kStep_s / task_.battery.charge_s_per_unit);
        return;
      }
      if (!there) return;
      ready_s_ += kStep_s;
      if (ready_s_ < task_.charger.take_off_s) return;
      docked_ = false;
      take_off();
      return;
    }
    if (meetings.empty()) return;
    drive(meetings.front().site_m);
    const bool meet = !flying_ && has_flown_ && (robot_ - meetings.front().site_m).head<2>().norm() < 0.5 &&
                      (position_ - robot_).head<2>().norm() < 1.0;
    if (!meet) return;
    docked_ = true;
    meeting_ = meetings.front();
    handling_s_ = task_.charger.landing_s;
    ready_s_ = 0.0;
  }
  void drive(const Vec3& to) {
    const Vec3 way(to.x() - robot_.x(), to.y() - robot_.y(), 0.0);
    const double most = task_.charger.speed_mps * kStep_s;
    robot_ += way.norm() <= most ? way : Vec3(way.normalized() * most);
  }
  void take_off() {
    flying_ = true;
    has_flown_ = true;
    covering_ = false;
    leg_ = legs_done_;
    plan_route(From::kGround);
  }

  void events() {
    if (flying_ && weather_.loss_at_s >= 0.0 && time_ >= weather_.loss_at_s) {
      energy_ -= weather_.loss;
      weather_.loss_at_s = -1.0;
    }
    if (flying_ && covering_ && weather_.force_landing_s >= 0.0 && time_ >= weather_.force_landing_s) {
      weather_.force_landing_s = -1.0;
      route_.clear();
      land_below(position_, leg_);
      forced_ = true;
    }
  }

  void step() {
    time_ += kStep_s;
    if (++ticks_ % 10 == 0) gust_ = rng_.uniform(-1.0, 1.0);
    events();
    if (flying_) {
      fly_step();
    } else {
      velocity_ = Vec3::Zero();
      rest_s_ += kStep_s;
      if (!has_flown_ && rest_s_ > 1.0) take_off();
      forced_ = false;
    }
    robot_step();
    Vec3 seen = position_;
    const bool swerves = flying_ && covering_ && weather_.skip_from_s >= 0.0 && time_ >= weather_.skip_from_s;
    if (swerves && swerve_s_ < 4.0) {
      swerve_s_ += kStep_s;
      seen.z() += 10.0;
    } else if (flying_ && covering_) {
      log_.covered.push_back(seen);
      log_.cover_flight_m += velocity_.norm() * kStep_s;
    }
    log_.energy_min = std::min(log_.energy_min, energy_);
    log_.energy_max = std::max(log_.energy_max, energy_);
    AircraftView view;
    view.time_s = time_;
    view.position_m = seen;
    view.velocity_mps = velocity_;
    view.leg_index = leg_;
    view.legs_done = legs_done_;
    const bool low = position_.z() < 1.0 || forced_;
    view.mode = docked_ ? AircraftMode::kDocked
                        : (!flying_ ? AircraftMode::kLanded
                                    : (velocity_.z() < -0.1 && velocity_.head<2>().norm() < 0.1
                                           ? AircraftMode::kLanding
                                           : (low ? AircraftMode::kTakingOff : AircraftMode::kFlying)));
    news(keeper_.on_vehicle(view));
    if (ticks_ % 10 == 0 && !forced_) news(keeper_.on_battery({time_, energy_}));
    if (ticks_ % 5 == 0) news(keeper_.on_robot({time_, robot_, docked_, false}));
  }

  PlanKeeper& keeper_;
  MissionWeather weather_;
  Rng rng_;
  Task task_;
  Vec3 position_;
  Vec3 robot_;
  Vec3 velocity_ = Vec3::Zero();
  double energy_;
  double time_ = 0.0;
  double gust_ = 0.0;
  double rest_s_ = 0.0;
  double handling_s_ = 0.0;
  double ready_s_ = 0.0;
  double swerve_s_ = 0.0;
  int ticks_ = 0;
  bool flying_ = false;
  bool docked_ = false;
  bool has_flown_ = false;
  bool covering_ = false;
  bool forced_ = false;
  std::size_t leg_ = 0;
  std::size_t legs_done_ = 0;
  Rendezvous meeting_;
  std::deque<Target> route_;
  std::vector<Leg> prefix_;
  std::size_t done_before_ = 0;
  MissionLog log_;
};

}  // namespace

MissionLog fly(PlanKeeper& keeper, const MissionWeather& weather, std::uint64_t seed, double most_s) {
  return TinyMission(keeper, weather, seed).run(most_s);
}

}  // namespace swallowtail::coverage::test
