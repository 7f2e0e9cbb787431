// Real terrain and real parcels through the commands. The data are not part of the project: SWALLOWTAIL_DATA
// names their folder (default /work/shared/data); without it these tests are skipped.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "planner/world/raster_file.hpp"
#include "tests/golden/run.hpp"

namespace swallowtail {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

fs::path data_folder() {
  const char* named = std::getenv("SWALLOWTAIL_DATA");
  return named != nullptr ? fs::path(named) : fs::path("/work/shared/data");
}

#define SKIP_WITHOUT(path) \
  if (!fs::exists(path)) GTEST_SKIP() << "no real data: " << (path) << " is not there (set SWALLOWTAIL_DATA)"

/// Scenario of the public SPSO code: grid coordinates count cells of 5 m from 1, rows from the north; z is
/// above ground.
struct GridScene {
  static constexpr double kCell_m = 5.0;
  int rows = 0;
  Vec3 start = Vec3::Zero();
  Vec3 goal = Vec3::Zero();
  std::vector<Vec3> threats;  // x, y, radius in cells

  Vec2 local_m(const Vec3& grid) const {
    return {(grid.x() - 1.0) * kCell_m, (static_cast<double>(rows) - grid.y()) * kCell_m};
  }
};

GridScene read_grid_scene(const fs::path& file) {
  GridScene scene;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string key;
    Vec3 value = Vec3::Zero();
    words >> key >> value.x() >> value.y() >> value.z();
    if (key == "size") scene.rows = static_cast<int>(value.y());
    if (key == "start") scene.start = value;
    if (key == "goal") scene.goal = value;
    if (key == "threat") scene.threats.push_back(value);
  }
  return scene;
}

std::string scenario_text(const GridScene& scene, const fs::path& dem, const planner::Terrain& terrain) {
  std::ostringstream out;
  const auto point = [&](const Vec3& grid) {
    const Vec2 p = scene.local_m(grid);
    std::ostringstream text;
    text << "[" << p.x() << ", " << p.y() << ", " << terrain.height_at(p.x(), p.y()) + grid.z() << "]";
    return text.str();
  };
  out << "swallowtail: 1\nname: SPSO demo\nbounds_m: {min: [0, 0, 0], max: [5220, 4390, 700]}\nterrain: "
         "{kind: raster, file: "
      << dem.string() << ", no_data_elevation_m: 0}\nobstacles:\n";
  for (std::size_t i = 0; i < scene.threats.size(); ++i) {
    const Vec2 p = scene.local_m(scene.threats[i]);
    out << "  - {id: " << i + 1 << ", shape: cylinder, base_m: [" << p.x() << ", " << p.y()
        << ", 0], radius_m: " << scene.threats[i].z() * GridScene::kCell_m << ", height_m: 1000}\n";
  }
  out << "vehicle: {radius_m: 1, margin_m: 10, cruise_speed_mps: 15, turn_max_deg: 60, climb_max_deg: "
         "45}\nstart_m: "
      << point(scene.start) << "\ngoal_m: " << point(scene.goal) << "\nplanning: {waypoints: 10}\n";
  return out.str();
}

TEST(RealData, PathOverChristmasIslandIsCertified) {
  const fs::path dem = data_folder() / "terrain/christmas_island_spso_5m.tif";
  SKIP_WITHOUT(dem);
  const auto terrain = planner::read_terrain(dem.string(), {});
  ASSERT_TRUE(terrain.ok()) << terrain.error().message;
  const GridScene scene = read_grid_scene(data_folder() / "terrain/scenarios/spso_demo.txt");
  ASSERT_EQ(scene.threats.size(), 6u);
  const test::ScratchFolder folder;
  std::ofstream(folder.file("spso.yaml")) << scenario_text(scene, dem, terrain.value());

  const test::Outcome plan =
      test::run({"plan", folder.file("spso.yaml"), "--json", "-o", folder.file("plan.json")});
  ASSERT_EQ(plan.exit_code, 0) << plan.err << plan.out.substr(0, 500);
  const json answer = json::parse(plan.out);
  const double straight_m = (scene.local_m(scene.goal) - scene.local_m(scene.start)).norm();
  EXPECT_GE(answer["length_m"].get<double>(), straight_m);
  EXPECT_LE(answer["length_m"].get<double>(), 1.5 * straight_m);
  EXPECT_GE(answer["clearance_min_m"].get<double>(), 11.0);
  EXPECT_EQ(
      test::run({"check", folder.file("spso.yaml"), "--plan", folder.file("plan.json"), "-q"}).exit_code, 0);
}

TEST(RealData, FrontOverChristmasIslandCoversTheObjectives) {
  const fs::path file = data_folder() / "terrain/scenarios/nmopso_sc6.txt";
  SKIP_WITHOUT(file);
  const test::ScratchFolder folder;
  const test::Outcome plan =
      test::run({"plan", file.string(), "--algorithm", "nmopso", "--json", "-o", folder.file("front.csv")});
  ASSERT_EQ(plan.exit_code, 0) << plan.err << plan.out.substr(0, 500);
  const json answer = json::parse(plan.out);
  EXPECT_GE(answer["hypervolume"].get<double>(), 0.91);
  const json& flown = answer["front"][answer["flown"].get<std::size_t>()];
  EXPECT_EQ(flown["certified"], true);
  EXPECT_EQ(flown["waypoints_m"].size(), 12u);
  std::ifstream csv(folder.file("front.csv"));
  std::size_t lines = 0;
  for (std::string line; std::getline(csv, line);) ++lines;
  EXPECT_EQ(lines, answer["front"].size() + 1);
}

struct FieldsCase {
  const char* file;
  std::vector<std::string> options;
  std::size_t fields;
};

void PrintTo(const FieldsCase& fields, std::ostream* out) { *out << fields.file; }

class RealFields : public ::testing::TestWithParam<FieldsCase> {};

TEST_P(RealFields, AreCoveredOrRefusedWithAReason) {
  const fs::path file = data_folder() / "fields" / GetParam().file;
  SKIP_WITHOUT(file);
  std::vector<std::string> arguments = {"cover", file.string(), "--json"};
  arguments.insert(arguments.end(), GetParam().options.begin(), GetParam().options.end());
  const test::Outcome outcome = test::run(arguments);
  ASSERT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 1) << outcome.err;
  const json answer = json::parse(outcome.out);
  ASSERT_EQ(answer["fields"].size(), GetParam().fields);
  std::size_t planned = 0;
  for (const json& field : answer["fields"]) {
    if (field["status"] == "planned") {
      ++planned;
      EXPECT_GE(field["covered_m2"].get<double>(), 0.995 * field["area_m2"].get<double>()) << field["id"];
    } else {
      EXPECT_FALSE(field["reason"].get<std::string>().empty()) << field["id"];
    }
  }
  EXPECT_EQ(outcome.exit_code == 0, planned == answer["fields"].size());
  EXPECT_GE(planned * 10, answer["fields"].size() * 9) << "at least nine of ten real fields are planned";
}

INSTANTIATE_TEST_SUITE_P(Files, RealFields,
                         ::testing::Values(FieldsCase{"nl.geojson", {"--sensor-width", "20"}, 100},
                                           FieldsCase{"jecam.geojson", {"--sensor-width", "20"}, 100},
                                           FieldsCase{"fields2cover.geojson", {"--sensor-width", "20"}, 3},
                                           FieldsCase{"holes_alenex24.local.geojson",
                                                      {"--sensor-width", "4", "--mission", "each"},
                                                      10}));

}  // namespace
}  // namespace swallowtail
