#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "planner/scenario/read.hpp"

namespace swallowtail::sim {

/// A field of 100 m × 20 m at (0, 0), in local metres, and the scenario text around it.
inline constexpr const char* kFields =
    R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"id":"f","crs":"local metres"},
"geometry":{"type":"Polygon","coordinates":[[[0,0],[100,0],[100,20],[0,20],[0,0]]]}}]})";

inline constexpr const char* kScenario = R"(swallowtail: 1
name: test
bounds_m: {min: [-100, -100, -10], max: [300, 300, 100]}
terrain: {kind: flat, elevation_m: 0}
vehicle: {radius_m: 0.5, margin_m: 2, cruise_speed_mps: 10, climb_speed_mps: 4, descent_speed_mps: 4, energy_model: document}
coverage:
  fields: fields.geojson
  sensor_width_m: 10
  heights: {default_m: 20}
  battery: {capacity: 100, levels: 10, reserve: 10, charge_s_per_unit: 0.5}
  charger: {speed_mps: 3, take_off_s: 2, landing_s: 2, start_m: [-20, 5]}
)";

/// Writes the fields beside a scenario made of kScenario and `more`, and reads it.
inline planner::Scenario scenario_with(const std::string& more = {}) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) /
      (std::string("swallowtail_sim_") + test->test_suite_name() + "_" + test->name());
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "fields.geojson") << kFields;
  const auto scenario = planner::parse_scenario(kScenario + more, "test.yaml", folder.string());
  EXPECT_TRUE(scenario.ok()) << (scenario.ok() ? "" : scenario.errors().text());
  return *scenario;
}

}  // namespace swallowtail::sim
