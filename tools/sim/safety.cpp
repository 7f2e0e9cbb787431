#include "tools/sim/safety.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace swallowtail::sim {
namespace {

/// Clearances are lower bounds to within this; a path that is certified to the limit must not be counted.
constexpr double kSlack_m = 1e-3;
constexpr double kBelowGround_m = 0.05;
constexpr double kNoFlySlack_m = 0.01;

bool is_near_ground_by_intent(data::VehicleMode mode) {
  return mode == data::VehicleMode::kTakingOff || mode == data::VehicleMode::kLanding;
}

std::string describe(const Motion& at, const char* what, double distance_m, std::uint32_t obstacle_id) {
  char text[160];
  std::snprintf(text, sizeof text, "at %.2f s, (%.1f, %.1f, %.1f) m: %s %u at %.3f m", at.time_s,
                at.position_m.x(), at.position_m.y(), at.position_m.z(), what, obstacle_id, distance_m);
  return text;
}

}  // namespace

Safety::Safety(const planner::VehicleLimits& limits, std::shared_ptr<const planner::World> world,
               std::vector<coverage::Polygon> no_fly)
    : limits_(limits), no_fly_(std::move(no_fly)) {
  query_.emplace(std::move(world));
}

void Safety::watch_no_fly(const Motion& to) {
  const Vec2 at = to.position_m.head<2>();
  const auto within = std::ranges::find_if(no_fly_, [&](const coverage::Polygon& area) {
    return coverage::contains(area, at) && coverage::border_distance_m(area, at) > kNoFlySlack_m;
  });
  const bool is_within = !to.on_ground() && within != no_fly_.end();
  if (is_within && !was_within_) {
    ++violations_;
    const auto index = static_cast<std::uint32_t>(within - no_fly_.begin());
    if (first_violation_.empty())
      first_violation_ = describe(to, "inside no-fly area", -coverage::border_distance_m(*within, at), index);
  }
  was_within_ = is_within;
}

void Safety::change_world(std::shared_ptr<const planner::World> world) { query_.emplace(std::move(world)); }

void Safety::observe(const Motion& from, const Motion& to) {
  watch_no_fly(to);
  if (from.on_ground() && to.on_ground()) {
    clearance_m_ = 0.0;
    was_violated_ = was_collided_ = false;
    return;
  }
  const planner::Clearance near = query_->of_flight(from.position_m, from.time_s, to.position_m, to.time_s);
  const double height_m = query_->world().terrain().min_height_above(from.position_m, to.position_m);
  clearance_m_ = std::min(near.distance_m, height_m);
  const double kept_m = limits_.clearance_m();
  const bool low_by_intent = is_near_ground_by_intent(from.mode) || is_near_ground_by_intent(to.mode) ||
                             from.on_ground() || to.on_ground();
  least_clearance_m_ = std::min(least_clearance_m_, low_by_intent ? near.distance_m : clearance_m_);

  const bool near_obstacle = near.slack_m < kept_m - kSlack_m;
  const bool near_ground = !low_by_intent && height_m < kept_m - kSlack_m;
  const bool hit = near.distance_m < limits_.radius_m - kSlack_m || height_m < -kBelowGround_m;
  const bool violated = near_obstacle || near_ground || hit;
  if (violated && !was_violated_) {
    ++violations_;
    if (first_violation_.empty()) {
      first_violation_ = near_ground || height_m < near.distance_m
                             ? describe(to, "ground", height_m, 0)
                             : describe(to, "obstacle", near.distance_m, near.obstacle_id);
    }
  }
  if (hit && !was_collided_) ++collisions_;
  was_violated_ = violated;
  was_collided_ = hit;
}

}  // namespace swallowtail::sim
