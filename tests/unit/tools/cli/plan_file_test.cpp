#include "tools/cli/plan_file.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tools/cli/energy.hpp"

namespace swallowtail::cli {
namespace {

planner::PricedReport some_report() {
  planner::PricedReport priced;
  planner::PlanReport& report = priced.plan;
  report.status = planner::PlanStatus::kCertified;
  report.path = {{0.0, {1, 2, 0}, planner::Phase::kTransfer, 0},
                 {4.25, {1, 2, 10.1}, planner::Phase::kTakeOff, 0},
                 {9.5, {31.5, 2, 10.1}, planner::Phase::kCover, 3},
                 {11.5, {31.5, 2, 10.1}, planner::Phase::kHold, 3},
                 {16.0, {31.5, 2, 0}, planner::Phase::kLanding, 4}};
  report.length_m = 50.7;
  priced.terms = {51.7, {{"length", 1.0, 50.7}, {"collision", 100.0, 0.01}}};
  return priced;
}

TEST(PlanFile, WhatIsWrittenIsReadBack) {
  const planner::PricedReport priced = some_report();
  const planner::PlanReport& report = priced.plan;
  planner::PricedRequest request;
  request.plan.goal_m = Vec3(31.5, 2, 0);
  const auto path = parse_plan(to_json(priced, "scene", request).dump(), "plan.json");
  ASSERT_TRUE(path.ok()) << path.error().message;
  ASSERT_EQ(path.value().size(), report.path.size());
  for (std::size_t i = 0; i < report.path.size(); ++i) {
    EXPECT_EQ(path.value()[i].time_s, report.path[i].time_s);
    EXPECT_EQ(path.value()[i].position_m, report.path[i].position_m);
    EXPECT_EQ(path.value()[i].phase, report.path[i].phase);
    EXPECT_EQ(path.value()[i].leg_index, report.path[i].leg_index);
  }
}

TEST(PlanFile, PlacesLeaveOutStops) {
  const auto json = to_json(some_report(), "scene", {});
  EXPECT_EQ(json["waypoints"].size(), 5u);
  EXPECT_EQ(json["waypoints_m"].size(), 4u);
}

TEST(PlanFile, TheCostStandsTermByTerm) {
  planner::PricedRequest request;
  request.cost.preset = "BOA";
  const auto cost = to_json(some_report(), "scene", request)["cost"];
  EXPECT_EQ(cost["preset"], "BOA");
  EXPECT_EQ(cost["total"], 51.7);
  EXPECT_EQ(cost["collision"], 1.0);
  EXPECT_EQ(cost["terms"][1]["weight"], 100.0);
  EXPECT_EQ(cost["terms"][1]["value"], 0.01);
}

TEST(PlanFile, WhatIsNoPlanIsRefusedByPlaceAndRule) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "JSON"},
      {"[1, 2]", "waypoints"},
      {"{\"waypoints\": 3}", "waypoints"},
      {"{\"waypoints\": []}", "waypoints"},
      {"{\"waypoints\": [7]}", "waypoints[0]"},
      {"{\"waypoints\": [{\"position_m\": [1, 2, 3]}]}", "waypoints[0].time_s"},
      {"{\"waypoints\": [{\"time_s\": null, \"position_m\": [1, 2, 3]}]}", "waypoints[0].time_s"},
      {"{\"waypoints\": [{\"time_s\": 1, \"position_m\": [1, 2]}]}", "waypoints[0].position_m"},
      {"{\"waypoints\": [{\"time_s\": 1, \"position_m\": [1, 2, \"3\"]}]}", "waypoints[0].position_m"},
      {"{\"waypoints\": [{\"time_s\": 1, \"position_m\": [1, 2, 3], \"phase\": \"glide\"}]}",
       "waypoints[0].phase"},
      {"{\"waypoints\": [{\"time_s\": 1, \"position_m\": [1, 2, 3], \"leg_index\": -1}]}",
       "waypoints[0].leg_index"},
      {"{\"waypoints\": [{\"time_s\": 1, \"position_m\": [1, 2, 3], \"leg_index\": 4294967296}]}",
       "waypoints[0].leg_index"},
      {"{\"waypoints\": [{\"time_s\": 1e999, \"position_m\": [1, 2, 3]}]}", ""},
  };
  for (const auto& [text, place] : cases) {
    const auto path = parse_plan(text, "plan.json");
    ASSERT_FALSE(path.ok()) << text;
    EXPECT_EQ(path.error().code, Error::Code::kBadInput);
    EXPECT_NE(path.error().message.find(place), std::string::npos) << path.error().message;
  }
}

TEST(PlanFile, GeoJsonWithoutOriginSaysThatItIsLocal) {
  const auto json = nlohmann::json::parse(path_geojson(some_report().plan.path, std::nullopt));
  EXPECT_EQ(json["features"][0]["properties"]["crs"], "local metres");
  EXPECT_EQ(json["features"][0]["geometry"]["coordinates"][1], nlohmann::json({1.0, 2.0, 10.1}));
}

TEST(PlanFile, GeoJsonAroundAnOriginIsLongitudeLatitudeElevation) {
  const planner::GeoOrigin origin{52.1, 5.3, 12.0};
  const planner::TimedPath path = {{0.0, {0, 0, 5}, planner::Phase::kTransfer, 0},
                                   {1.0, {0, 1000, 5}, planner::Phase::kTransfer, 0}};
  const auto json = nlohmann::json::parse(path_geojson(path, origin));
  const auto& line = json["features"][0]["geometry"]["coordinates"];
  EXPECT_NEAR(line[0][0].get<double>(), 5.3, 1e-9);
  EXPECT_NEAR(line[0][1].get<double>(), 52.1, 1e-9);
  EXPECT_NEAR(line[0][2].get<double>(), 17.0, 1e-9);
  EXPECT_NEAR(line[1][1].get<double>(), 52.1 + 1000.0 / 111260.0,
              1e-5);  // a degree of latitude at 52.1° is 111.26 km
}

TEST(Energy, EachPhaseHasItsRate) {
  const coverage::EnergyModel rates{
      .level_per_s = 2, .climb_per_s = 3, .descent_per_s = 0.5, .hover_per_s = 1, .landed_per_s = 0};
  // up 4.25 s, level 5.25 s, standing 2 s, down 4.5 s
  EXPECT_DOUBLE_EQ(energy_of(some_report().plan.path, rates), 4.25 * 3 + 5.25 * 2 + 2 * 1 + 4.5 * 0.5);
}

}  // namespace
}  // namespace swallowtail::cli
