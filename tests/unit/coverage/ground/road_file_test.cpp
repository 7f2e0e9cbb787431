#include "coverage/ground/road_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace swallowtail::coverage {
namespace {

using testing::HasSubstr;

const std::string kRoads = std::string(SWALLOWTAIL_SOURCE_DIR) + "/tests/data/scenarios/roads.geojson";

class RoadFile : public testing::Test {
 protected:
  std::string write(const std::string& text) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("swallowtail_roads_" + std::to_string(getpid()) + ".geojson");
    std::ofstream(path) << text;
    path_ = path.string();
    return path_;
  }
  ~RoadFile() override {
    if (!path_.empty()) std::filesystem::remove(path_);
  }

 private:
  std::string path_;
};

TEST_F(RoadFile, BringsDegreesIntoTheLocalFrame) {
  const auto roads = read_roads(kRoads, planner::GeoOrigin{52.1, 5.3, 12.0});
  ASSERT_TRUE(roads.ok()) << roads.error().message;
  ASSERT_EQ(roads->size(), 2U);
  EXPECT_EQ((*roads)[0].size(), 4U);
  const Vec2& lane = (*roads)[1][0];
  EXPECT_NEAR(lane.x(), 0.0035 * 111320.0 * 0.61428, 1.0) << "a degree of longitude at 52.1 north";
  EXPECT_NEAR(lane.y(), 0.0009 * 111260.0, 0.5);
  EXPECT_LT(((*roads)[0][2] - lane).norm(), 1e-9) << "they meet";
}

TEST_F(RoadFile, TakesLocalMetresAsTheyAre) {
  const auto roads = read_roads(write(R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"crs": "local metres"}, "geometry":
      {"type": "MultiLineString", "coordinates": [[[0, 0], [5, 1]], [[5, 1], [9, 9], [10, 10]]]}}]})"),
                                std::nullopt);
  ASSERT_TRUE(roads.ok()) << roads.error().message;
  ASSERT_EQ(roads->size(), 2U);
  EXPECT_EQ((*roads)[1][1], Vec2(9, 9));
}

TEST_F(RoadFile, SaysWhatIsWrong) {
  EXPECT_EQ(read_roads("/nowhere/roads.geojson", std::nullopt).error().code, Error::Code::kNotFound);
  EXPECT_THAT(read_roads(kRoads, std::nullopt).error().message, HasSubstr("no origin"));
  EXPECT_THAT(read_roads(kRoads, planner::GeoOrigin{10.0, 5.3, 0.0}).error().message, HasSubstr("200 km"));
  EXPECT_THAT(read_roads(write("no roads"), std::nullopt).error().message, HasSubstr("not a vector file"));
  EXPECT_THAT(
      read_roads(write(R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {},
    "geometry": {"type": "Point", "coordinates": [5, 52]}}]})"),
                 planner::GeoOrigin{52.0, 5.0, 0.0})
          .error()
          .message,
      HasSubstr("no line"));
}

}  // namespace
}  // namespace swallowtail::coverage
