#include "tools/mission/check/solids_of.hpp"

#include <algorithm>
#include <map>
#include <variant>

namespace swallowtail::check {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

P3 point(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Solid solid_of(const planner::Obstacle& obstacle, double appears_s) {
  Solid solid;
  solid.id = obstacle.id;
  solid.at = point(obstacle.position_m);
  solid.velocity_mps = point(obstacle.velocity_mps);
  solid.since_s = obstacle.state_time_s;
  solid.appears_s = appears_s;
  solid.vanishes_s = obstacle.valid_until_s;
  solid.margin_m = obstacle.margin_m;
  std::visit(Overloaded{
                 [&](const planner::Sphere& s) { solid.radius_m = s.radius_m; },
                 [&](const planner::Cylinder& s) {
                   solid.shape = data::ObstacleShape::kCylinder;
                   solid.radius_m = s.radius_m;
                   solid.height_m = s.height_m;
                 },
                 [&](const planner::Cone& s) {
                   solid.shape = data::ObstacleShape::kCone;
                   solid.radius_m = s.radius_m;
                   solid.height_m = s.height_m;
                 },
                 [&](const planner::Box& s) {
                   solid.shape = data::ObstacleShape::kBox;
                   solid.size_m = point(s.size_m);
                   solid.yaw_rad = s.yaw_rad;
                 },
                 [&](const planner::ConvexMesh& s) {
                   solid.shape = data::ObstacleShape::kMesh;
                   solid.yaw_rad = s.yaw_rad;
                   for (const auto& v : s.vertices_m) solid.vertices.push_back(point(v));
                 },
             },
             obstacle.shape);
  return solid;
}

/// Ends a solid at a time and gives the one that goes on from there with another velocity.
Solid restated(Solid& solid, double time_s, const P3& velocity_mps) {
  Solid next = solid;
  const double age = time_s - solid.since_s;
  next.at = {solid.at.x + solid.velocity_mps.x * age, solid.at.y + solid.velocity_mps.y * age,
             solid.at.z + solid.velocity_mps.z * age};
  next.since_s = time_s;
  next.appears_s = time_s;
  next.velocity_mps = velocity_mps;
  solid.vanishes_s = std::min(solid.vanishes_s, time_s);
  return next;
}

}  // namespace

std::vector<Solid> solids_of(const planner::Scenario& scenario) {
  std::vector<Solid> solids;
  std::map<std::uint32_t, std::size_t> standing;
  const auto put = [&](Solid solid) {
    standing[solid.id] = solids.size();
    solids.push_back(std::move(solid));
  };
  for (const auto& obstacle : scenario.obstacles) put(solid_of(obstacle, 0.0));
  for (const auto& event : scenario.events) {
    const double at = event.at_s;
    std::visit(Overloaded{
                   [&](const planner::ObstacleAppears& e) { put(solid_of(e.obstacle, at)); },
                   [&](const planner::ObstacleMoves& e) {
                     const auto found = standing.find(e.id);
                     if (found != standing.end())
                       put(restated(solids[found->second], at, point(e.velocity_mps)));
                   },
                   [&](const planner::ObstacleVanishes& e) {
                     const auto found = standing.find(e.id);
                     if (found != standing.end())
                       solids[found->second].vanishes_s = std::min(solids[found->second].vanishes_s, at);
                   },
                   [](const planner::BatteryLoss&) {},
                   [](const planner::ChargerDelay&) {},
                   [](const planner::ChargerLoss&) {},
                   [](const planner::AircraftReplaced&) {},
               },
               event.what);
  }
  return solids;
}

}  // namespace swallowtail::check
