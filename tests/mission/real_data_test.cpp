#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "planner/world/raster_file.hpp"
#include "tests/mission/flight.hpp"

// Missions over DDS on real terrain and real parcels. The data are not part of the project: SWALLOWTAIL_DATA
// names their folder (default ../shared/data); without it these tests are skipped. Domains 178 and 179.
namespace swallowtail {
namespace {

namespace fs = std::filesystem;
using testing::Limit;

fs::path data_folder() {
  const char* named = std::getenv("SWALLOWTAIL_DATA");
  return named != nullptr ? fs::path(named) : fs::path(SWALLOWTAIL_SOURCE_DIR) / "../shared/data";
}

/// The scene of the public SPSO code: grid coordinates count cells of 5 m from 1, rows from the north.
struct Island {
  static constexpr double kCell_m = 5.0;
  planner::Terrain terrain;
  std::string head;  ///< of a scenario: bounds, terrain, the six cylinders
  Vec3 start_m = Vec3::Zero();
  Vec3 goal_m = Vec3::Zero();
};

std::string text_of(const Vec3& p) {
  std::ostringstream text;
  text << "[" << p.x() << ", " << p.y() << ", " << p.z() << "]";
  return text.str();
}

Island read_island(const fs::path& terrain_file, const fs::path& scene_file) {
  auto terrain = planner::read_terrain(terrain_file.string(), {});
  if (!terrain) throw std::runtime_error(terrain.error().message);
  Island island{std::move(terrain).value(), {}, {}, {}};
  std::ostringstream obstacles;
  int rows = 0;
  int threats = 0;
  const auto at = [&](const Vec3& grid) {
    const double x = (grid.x() - 1.0) * Island::kCell_m;
    const double y = (rows - grid.y()) * Island::kCell_m;
    return Vec3(x, y, island.terrain.height_at(x, y) + grid.z());
  };
  std::ifstream stream(scene_file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string key;
    Vec3 value = Vec3::Zero();
    words >> key >> value.x() >> value.y() >> value.z();
    if (key == "size") rows = static_cast<int>(value.y());
    if (key == "start") island.start_m = at(value);
    if (key == "goal") island.goal_m = at(value);
    if (key != "threat") continue;
    const Vec3 base = at({value.x(), value.y(), 0.0});
    obstacles << "  - {id: " << ++threats << ", shape: cylinder, base_m: [" << base.x() << ", " << base.y()
              << ", 0], radius_m: " << value.z() * Island::kCell_m << ", height_m: 1000}\n";
  }
  island.head =
      "swallowtail: 1\nbounds_m: {min: [0, 0, 0], max: [5220, 4390, 700]}\nterrain: {kind: raster, file: " +
      fs::canonical(terrain_file).string() + ", no_data_elevation_m: 0}\nobstacles:\n" + obstacles.str();
  return island;
}

class RealMission : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const auto* name :
         {"terrain/christmas_island_spso_5m.tif", "terrain/scenarios/spso_demo.txt", "fields/dk.geojson"}) {
      if (!fs::exists(data_folder() / name))
        GTEST_SKIP() << "no real data: " << data_folder() / name << " is not there (set SWALLOWTAIL_DATA)";
    }
    island_.emplace(read_island(data_folder() / "terrain/christmas_island_spso_5m.tif",
                                data_folder() / "terrain/scenarios/spso_demo.txt"));
  }

  /// Flies a scenario and returns the answer of `swallowtail mission`, which judges it by the independent
  /// checker.
  static nlohmann::json fly(const std::string& name, const std::string& scenario, int domain, int rate) {
    const std::string folder = testing::clean_folder("mission_real_" + name);
    const std::string file = folder + "/scenario.yaml";
    std::ofstream(file) << scenario;
    testing::Program mission({testing::program_file("swallowtail"), "mission", file, "--domain",
                              std::to_string(domain), "--rate", std::to_string(rate), "--record",
                              folder + "/flight.mcap", "--json"});
    EXPECT_EQ(mission.finish(Limit(110)), 0) << mission.err() << mission.out();
    return nlohmann::json::parse(mission.out(), nullptr, false);
  }

  std::optional<Island> island_;
};

TEST_F(RealMission, FliesAcrossTheIslandRoundAnObstacleThatAppearsOnItsWay) {
  // The obstacle stands on the first plan's way, between the cylinders.
  const std::string scenario =
      island_->head +
      "name: island goal\n"
      "vehicle: {radius_m: 1, margin_m: 10, cruise_speed_mps: 15, climb_speed_mps: 5, descent_speed_mps: 5}\n"
      "start_m: " +
      text_of(island_->start_m) + "\ngoal_m: " + text_of(island_->goal_m) +
      "\nevents:\n"
      "  - {at_s: 40, obstacle: {id: 9, shape: sphere, center_m: [2300, 2240, 345], radius_m: 60}}\n";
  const auto answer = fly("goal", scenario, 178, 30);
  ASSERT_TRUE(answer.is_object());
  EXPECT_EQ(answer["status"], "completed");
  EXPECT_TRUE(answer["violations"].empty()) << answer["violations"].dump(2);
  EXPECT_GE(answer["replans"], 2) << "the obstacle was not on the way";
  EXPECT_GE(answer["clearance_min_m"], 10.9);
  const double straight_s = (island_->goal_m - island_->start_m).norm() / 15.0;
  EXPECT_LE(answer["flight_s"], 1.5 * straight_s);
}

TEST_F(RealMission, CoversAParcelWithAHoleOnTheIsland) {
  const std::string scenario =
      island_->head +
      "name: island field\n"
      "vehicle: {radius_m: 0.5, margin_m: 2, cruise_speed_mps: 8, climb_speed_mps: 3, descent_speed_mps: "
      "2.5}\n"
      "coverage:\n"
      "  fields: " +
      fs::canonical(data_folder() / "fields/dk.geojson").string() +
      "\n"
      "  field_ids: [dk-19-0]\n"
      "  place_at_m: [4050, 1900]\n"
      "  sensor_width_m: 15\n"
      "  heights: {default_m: 30}\n"
      "  height_tolerance_m: 6\n"
      "  height_band_m: 4\n"
      "  battery: {capacity: 240, levels: 10, reserve: 20, charge_s_per_unit: 0.4}\n"
      "  charger: {speed_mps: 4, start_m: [3960, 1800]}\n"
      "events:\n"
      "  - {at_s: 60, obstacle: {id: 9, shape: sphere, center_m: [4070, 1841, 235], radius_m: 6}}\n"
      "  - {at_s: 350, battery_loss: 45}\n"
      "  - {at_s: 400, remove_obstacle: 9}\n";
  const auto answer = fly("cover", scenario, 179, 30);
  ASSERT_TRUE(answer.is_object());
  EXPECT_EQ(answer["status"], "completed");
  EXPECT_TRUE(answer["violations"].empty()) << answer["violations"].dump(2);
  EXPECT_GE(answer["covered_percent"], 99.5);
  EXPECT_GE(answer["recharges"], 1);
  EXPECT_GE(answer["coverage_revisions"], 2) << "neither the gap nor the loss changed the plan";
  EXPECT_GE(answer["energy_min"], 20.0);
}

}  // namespace
}  // namespace swallowtail
