#include "tools/sim/referee.hpp"

#include <cmath>
#include <cstdio>

namespace swallowtail::sim {
namespace {

constexpr double kMoved_m = 2.0;
constexpr double kCharged = 1.0;

Outcome failed(const char* format, double value) {
  char text[160];
  std::snprintf(text, sizeof text, format, value);
  return {.completed = false, .reason = text};
}

}  // namespace

void Referee::see_verdict(data::PathVerdict verdict, double time_s) {
  if (verdict != data::PathVerdict::kNoSafePath) {
    no_path_since_s_.reset();
  } else if (!no_path_since_s_) {
    no_path_since_s_ = time_s;
  }
}

std::optional<Outcome> Referee::judge(const Motion& motion, double energy) {
  if (const auto done = rules_.goal_m ? judge_goal(motion) : judge_coverage(motion)) return done;
  if (energy <= 0.0 && !motion.on_ground())
    return failed("the battery ran out in flight at %.1f s", motion.time_s);
  if (motion.time_s >= rules_.max_time_s) return failed("not completed within %.0f s", rules_.max_time_s);
  if (no_path_since_s_ && motion.time_s - *no_path_since_s_ > kNoPath_s) {
    return failed("the planner has had no safe path since %.1f s", *no_path_since_s_);
  }
  if (is_stuck(motion, energy)) {
    Outcome stuck = failed("nothing has happened since %.1f s", anchor_.time_s);
    if (!plan_.reason.empty()) stuck.reason += "; the coverage plan's last word: " + plan_.reason;
    return stuck;
  }
  return std::nullopt;
}

std::optional<Outcome> Referee::judge_goal(const Motion& motion) const {
  const bool rests =
      motion.velocity_mps.norm() < 1e-3 && (motion.on_ground() || motion.mode == data::VehicleMode::kHolding);
  if (!rests || (motion.position_m - *rules_.goal_m).norm() > kGoal_m) return std::nullopt;
  return Outcome{.completed = true, .reason = "completed"};
}

std::optional<Outcome> Referee::judge_coverage(const Motion& motion) {
  const bool all_flown = plan_.legs_total > 0 && motion.legs_done >= plan_.legs_total && motion.on_ground();
  if (!all_flown) {
    all_flown_since_s_.reset();
    return std::nullopt;
  }
  if (!all_flown_since_s_) all_flown_since_s_ = motion.time_s;
  const double stood_s = motion.time_s - *all_flown_since_s_;
  if (plan_.complete && stood_s >= rules_.grace_s) return Outcome{.completed = true, .reason = "completed"};
  if (stood_s < rules_.grace_s + kIncomplete_s) return std::nullopt;
  return Outcome{.completed = false, .reason = "the coverage plan leaves something out: " + plan_.reason};
}

bool Referee::is_stuck(const Motion& motion, double energy) {
  const bool moved = (motion.position_m - anchor_.position_m).norm() > kMoved_m;
  if (moved || motion.legs_done != anchor_.legs_done || energy > anchor_energy_ + kCharged) {
    anchor_ = motion;
    anchor_energy_ = energy;
  }
  return motion.time_s - anchor_.time_s > kStuck_s;
}

}  // namespace swallowtail::sim
