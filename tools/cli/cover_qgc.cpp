#include <algorithm>

#include "tools/cli/cover_files.hpp"

namespace swallowtail::cli {
namespace {

using Json = nlohmann::ordered_json;

// MAV_CMD, MAV_FRAME and QGroundControl's own numbers.
constexpr int kWaypoint = 16;
constexpr int kLand = 21;
constexpr int kTakeOff = 22;
constexpr int kDelay = 93;
constexpr int kMissionFrame = 2;
constexpr int kRelativeFrame = 3;
constexpr int kRelativeAltitude = 1;
constexpr int kGenericAutopilot = 0;
constexpr int kMultirotor = 2;

class MissionWriter {
 public:
  MissionWriter(const planner::GeoOrigin& origin, double home_z_m) : origin_(origin), home_z_m_(home_z_m) {}

  void at(int command, const Vec3& place) {
    const auto degrees = planner::to_geodetic(origin_, place.head<2>());
    const double height = place.z() - home_z_m_;
    Json item = {{"AMSLAltAboveTerrain", nullptr},
                 {"Altitude", height},
                 {"AltitudeMode", kRelativeAltitude},
                 {"autoContinue", true},
                 {"command", command},
                 {"doJumpId", static_cast<int>(items_.size()) + 1},
                 {"frame", kRelativeFrame}};
    item["params"] =
        Json::array({0, 0, 0, nullptr, degrees ? degrees->x() : 0.0, degrees ? degrees->y() : 0.0, height});
    item["type"] = "SimpleItem";
    items_.push_back(std::move(item));
  }
  void wait(double seconds) {
    Json item = {{"autoContinue", true},
                 {"command", kDelay},
                 {"doJumpId", static_cast<int>(items_.size()) + 1},
                 {"frame", kMissionFrame}};
    item["params"] = Json::array({seconds, -1, -1, -1, 0, 0, 0});
    item["type"] = "SimpleItem";
    items_.push_back(std::move(item));
  }
  Json take() { return std::move(items_); }

 private:
  planner::GeoOrigin origin_;
  double home_z_m_;
  Json items_ = Json::array();
};

Vec3 above(const Vec3& site, double z) { return {site.x(), site.y(), z}; }

/// Lands at the meeting, waits it out, and takes off where it ends.
void add_meeting(const coverage::Rendezvous& meeting, double altitude_m, MissionWriter& mission) {
  mission.at(kLand, meeting.site_m);
  mission.wait(std::max(0.0, meeting.depart_s - meeting.land_s));
  mission.at(kTakeOff, above(meeting.carry ? meeting.carry_to_m : meeting.site_m, altitude_m));
}

Json items_of(const coverage::Plan& plan, const Vec3& home, const planner::GeoOrigin& origin) {
  MissionWriter mission(origin, home.z());
  if (plan.take_off_s > 0.0) mission.wait(plan.take_off_s);
  mission.at(kTakeOff, above(home, plan.legs.front().entry_m.z()));
  for (const Vec3& corner : plan.approach_m) mission.at(kWaypoint, corner);
  auto meeting = plan.rendezvous.begin();
  for (std::size_t i = 0; i < plan.legs.size(); ++i) {
    const coverage::Leg& leg = plan.legs[i];
    mission.at(kWaypoint, leg.entry_m);
    mission.at(kWaypoint, leg.exit_m);
    if (i + 1 == plan.legs.size()) break;
    const coverage::Leg& next = plan.legs[i + 1];
    if (meeting != plan.rendezvous.end() && meeting->id == coverage::exit_id(i)) {
      add_meeting(*meeting++, next.entry_m.z(), mission);
    }
    for (const Vec3& corner : leg.transfer_m) mission.at(kWaypoint, corner);
    if (meeting != plan.rendezvous.end() && meeting->id == coverage::entry_id(i + 1)) {
      add_meeting(*meeting++, next.entry_m.z(), mission);
    }
  }
  const Vec3& end = plan.legs.back().exit_m;
  mission.at(kLand, above(end, end.z() - plan.legs.back().height_m));
  return mission.take();
}

Json fence(const coverage::Ring& ring, const planner::GeoOrigin& origin) {
  Json polygon = Json::array();
  for (const Vec2& p : ring) {
    const auto degrees = planner::to_geodetic(origin, p);
    if (degrees) polygon.push_back(Json::array({degrees->x(), degrees->y()}));
  }
  return {{"inclusion", false}, {"polygon", std::move(polygon)}, {"version", 1}};
}

Json document(const Covered& one) {
  const planner::GeoOrigin& origin = *one.task->origin;
  Json fences = Json::array();
  for (const coverage::Field& field : one.task->fields) {
    for (const coverage::Ring& hole : field.polygon.holes) fences.push_back(fence(hole, origin));
  }
  for (const coverage::Polygon& area : one.task->no_fly) fences.push_back(fence(area.outline, origin));
  const auto home = planner::to_geodetic(origin, one.task->start_m.head<2>());
  Json out;
  out["fileType"] = "Plan";
  out["geoFence"] = {{"circles", Json::array()}, {"polygons", std::move(fences)}, {"version", 2}};
  out["groundStation"] = "QGroundControl";
  Json mission;
  mission["cruiseSpeed"] = one.task->vehicle.cruise_speed_mps;
  mission["firmwareType"] = kGenericAutopilot;
  mission["globalPlanAltitudeMode"] = kRelativeAltitude;
  mission["hoverSpeed"] = one.task->vehicle.cruise_speed_mps;
  mission["items"] = items_of(*one.plan, one.task->start_m, origin);
  mission["plannedHomePosition"] =
      Json::array({home ? home->x() : origin.lat_deg, home ? home->y() : origin.lon_deg,
                   one.task->start_m.z() + origin.elevation_m});
  mission["vehicleType"] = kMultirotor;
  mission["version"] = 2;
  out["mission"] = std::move(mission);
  out["rallyPoints"] = {{"points", Json::array()}, {"version", 2}};
  out["version"] = 1;
  return out;
}

}  // namespace

Result<std::string> cover_qgc_plan(const std::vector<Covered>& done) {
  if (done.size() != 1) {
    return bad_input("A .plan file holds one mission, and this is " + std::to_string(done.size()) +
                     ": choose a field with --field, or --mission one.");
  }
  if (!done.front().task->origin)
    return bad_input("A .plan file needs places on Earth, and these fields are in local metres.");
  if (!done.front().plan) return infeasible("There is no plan to write to a .plan file.");
  return document(done.front()).dump(4) + "\n";
}

}  // namespace swallowtail::cli
