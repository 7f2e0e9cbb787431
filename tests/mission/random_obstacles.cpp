#include "tests/mission/random_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/participant/planner_participant.hpp"

namespace swallowtail::mission {
namespace {

constexpr double kAway_m = 160.0;         ///< north or south, that they come from: no strip is as far out
constexpr double kNoticeWall_s = 0.03;    ///< until a change is known to the planner
constexpr std::uint32_t kFirstId = 1000;  ///< of their obstacles

/// On a field or just beside it.
Vec2 place_to_stop(Rng& rng, const coverage::Polygon& field) {
  Vec2 middle = Vec2::Zero();
  for (const Vec2& p : field.outline) middle += p / static_cast<double>(field.outline.size());
  const Vec2& corner = field.outline[rng.below(field.outline.size())];
  return middle + rng.uniform(0.0, 1.1) * (corner - middle);
}

planner::Obstacle draw_body(Rng& rng, double height_m) {
  planner::Obstacle out;
  const double radius_m = rng.uniform(2.0, 5.0);
  if (rng.uniform() < 0.6) {
    out.shape = planner::Sphere{radius_m};
    out.position_m.z() = height_m + rng.uniform(-3.0, 3.0);
  } else {
    out.shape = planner::Cylinder{radius_m, height_m + rng.uniform(-4.0, 8.0)};
  }
  return out;
}

/// That gives moving obstacles enough margin to change their velocity by so much at any time.
double acceleration_for(double change_mps, double rate) {
  const planner::PlannerOptions options;
  const double lead_s = planner::PlannerParticipant::lead_s(rate, options.budget_ms);
  return 2.0 * change_mps * (lead_s + kNoticeWall_s * rate) / (lead_s * lead_s);
}

}  // namespace

void draw_obstacles(Rng& rng, RandomMission& mission) {
  if (rng.uniform() >= 0.4) return;
  planner::Scenario& scenario = mission.scenario;
  const auto count = static_cast<std::uint32_t>(1 + rng.below(4));
  double greatest_change_mps = 0.0;
  bool stays = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t field = rng.below(mission.fields.size());
    const auto& classes = scenario.coverage->heights.classes;
    const auto height = classes.find("f" + std::to_string(field));
    planner::Obstacle body =
        draw_body(rng, height != classes.end() ? height->second : scenario.coverage->heights.default_m);
    body.id = kFirstId + i;
    const Vec2 stop = place_to_stop(rng, mission.fields[field]);
    const Vec2 from(stop.x() + rng.uniform(-60.0, 60.0), rng.uniform() < 0.5 ? -kAway_m : kAway_m);
    const double speed_mps = rng.uniform(0.5, 2.0);
    const double arrives_s = (stop - from).norm() / speed_mps;
    body.margin_m = rng.uniform(0.0, 1.0);
    body.position_m.head<2>() = from;
    body.velocity_mps.head<2>() = (stop - from) / arrives_s;
    double time_s = rng.uniform(0.0, 400.0);
    body.state_time_s = time_s;
    scenario.events.push_back({time_s, planner::ObstacleAppears{body}});
    time_s += arrives_s;
    Vec3 onward_mps = Vec3::Zero();
    if (rng.uniform() < 0.4) {
      const double heading = rng.uniform(0.0, 2.0 * std::numbers::pi);
      onward_mps.head<2>() = rng.uniform(0.1, 1.0) * speed_mps * Vec2(std::cos(heading), std::sin(heading));
    }
    scenario.events.push_back({time_s, planner::ObstacleMoves{body.id, onward_mps}});
    greatest_change_mps = std::max(greatest_change_mps, (onward_mps - body.velocity_mps).norm());
    if (onward_mps.isZero() && rng.uniform() < 0.15) {
      stays = true;
      continue;
    }
    scenario.events.push_back({time_s + rng.uniform(10.0, 300.0), planner::ObstacleVanishes{body.id}});
  }
  mission.obstacles = static_cast<int>(count);
  mission.obstacle_stays = stays;
  mission.obstacle_acceleration_mps2 = acceleration_for(greatest_change_mps, mission.rate);
  std::ranges::stable_sort(scenario.events, {}, &planner::Event::at_s);
  mission.faults += std::to_string(count) + " obstacles" + (stays ? ", one for good; " : "; ");
}

}  // namespace swallowtail::mission
