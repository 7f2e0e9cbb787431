#include "planner/scenario/public_scene.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "planner/world/raster_file.hpp"

namespace swallowtail::planner {
namespace {

namespace fs = std::filesystem;

class PublicSceneTest : public ::testing::Test {
 protected:
  PublicSceneTest() {
    std::string name = (fs::temp_directory_path() / "swallowtail_scene_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    fs::create_directory(folder_ / "scenarios");
    TerrainGrid grid;
    grid.cell_size_m = 5.0;
    grid.rows = 20;
    grid.cols = 30;
    for (int r = 0; r < grid.rows; ++r) {
      for (int c = 0; c < grid.cols; ++c)
        grid.elevation_m.push_back(static_cast<float>(r == 19 && c == 2 ? 7 : -3));
    }
    EXPECT_TRUE(write_terrain((folder_ / "ground.tif").string(), grid, std::nullopt));
  }
  ~PublicSceneTest() override { fs::remove_all(folder_); }

  std::string write(const std::string& text) {
    const fs::path file = folder_ / "scenarios/scene.txt";
    std::ofstream(file) << text;
    return file.string();
  }
  std::string message(const std::string& text) {
    const auto scene = read_public_scene(write(text));
    return scene ? "" : scene.error().message;
  }

  fs::path folder_;
};

const std::string kSpheres =
    "# ours\nname S2\nbox 0 0 0 11 11 11\nstart 1 1 1\ngoal 10 10 10\nwaypoints 3\nsphere 4 4 4 1.5\nsphere "
    "8 8 8 1\n";
const std::string kGround =
    "dem ground.tif\nnegative_to_zero 1\nsize 30 20\nzlimits 10 20\nstart 3 1 15\ngoal 28 19 15\nwaypoints "
    "4\n"
    "angle_limit_deg 45\nweights 5 1 10 1\nthreat 15 10 4\n";

TEST_F(PublicSceneTest, ReadsSpheres) {
  const PublicScene scene = read_public_scene(write(kSpheres)).value();
  EXPECT_EQ(scene.scenario.name, "S2");
  EXPECT_EQ(scene.scenario.planning.waypoints, 3);
  EXPECT_EQ(*scene.scenario.goal_m, Vec3(10, 10, 10));
  ASSERT_EQ(scene.world->obstacles().size(), 2u);
  EXPECT_EQ(std::get<Sphere>(scene.world->obstacles()[0].shape).radius_m, 1.5);
  EXPECT_EQ(scene.world->bounds().max_m, Vec3(11, 11, 11));
}

// The raster's first row is the northernmost, y = 1; a cell counts as a metre and the sea as 0.
TEST_F(PublicSceneTest, CountsColumnsAndRowsFromOneAtTheFirstRow) {
  const PublicScene scene = read_public_scene(write(kGround)).value();
  const Terrain& terrain = scene.world->terrain();
  EXPECT_EQ(terrain.height_at(3, 1), 7.0);
  EXPECT_EQ(terrain.height_at(3, 2), 0.0);
  EXPECT_EQ(*scene.scenario.start_m, Vec3(3, 1, 22));
  EXPECT_EQ(*scene.scenario.goal_m, Vec3(28, 19, 15));
  EXPECT_EQ(scene.world->bounds().max_m, Vec3(30, 20, 27));
  EXPECT_EQ(scene.scenario.planning.cost, "SPSO");
  EXPECT_EQ(*scene.scenario.planning.altitude_m, Vec2(10, 20));
  EXPECT_EQ(std::get<Cylinder>(scene.world->obstacles()[0].shape).height_m, 27.0);
}

TEST_F(PublicSceneTest, SaysWhatIsWrong) {
  EXPECT_NE(read_public_scene((folder_ / "none.txt").string()).error().message.find("cannot be read"),
            std::string::npos);
  EXPECT_NE(message(kSpheres + "cube 1 2 3\n").find(":9: the key 'cube' is unknown"), std::string::npos);
  EXPECT_NE(message(kSpheres + "sphere 1 2 3\n").find("has 3 numbers; it needs 4"), std::string::npos);
  EXPECT_NE(message(kSpheres + "sphere 1 2 3 nan\n").find("'nan', which must be a finite number"),
            std::string::npos);
  EXPECT_NE(message(kSpheres + "goal 1 2 3\n").find("goal stands twice"), std::string::npos);
  EXPECT_NE(message("start 1 1 1\ngoal 2 2 2\nwaypoints 3\n").find("'box' is missing"), std::string::npos);
  EXPECT_NE(message("box 0 0 0 0 1 1\nstart 0 0 0\ngoal 0 1 1\nwaypoints 3\n").find("empty"),
            std::string::npos);
  std::string other_size = kGround;
  other_size.replace(other_size.find("size 30 20"), 10, "size 31 20");
  EXPECT_NE(message(other_size).find("size does not fit ground.tif"), std::string::npos);
}

}  // namespace
}  // namespace swallowtail::planner
