#include "coverage/field/geojson.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace swallowtail::coverage {
namespace {

using testing::HasSubstr;

class GeoJson : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }
  std::string file(const std::string& features, const std::string& more = "") {
    std::ofstream(path_) << R"({"type":"FeatureCollection")" << more << R"(,"features":[)" << features
                         << "]}";
    return path_;
  }
  const std::string path_ = std::filesystem::temp_directory_path() /
                            ("swallowtail_fields_" + std::to_string(getpid()) + ".geojson");
};

constexpr const char* kDegrees =
    R"({"type":"Feature","properties":{"id":"a","height_m":33},"geometry":{"type":"Polygon","coordinates":[[[5.0,52.0],[5.001,52.0],[5.001,52.001],[5.0,52.001],[5.0,52.0]]]}})";

TEST_F(GeoJson, DegreesAreProjectedAroundTheMiddle) {
  const auto fields = read_fields(file(kDegrees), {});
  ASSERT_TRUE(fields.ok()) << fields.error().message;
  ASSERT_EQ(fields->fields.size(), 1U);
  const Field& field = fields->fields.front();
  EXPECT_EQ(field.name, "a");
  EXPECT_EQ(field.height_m, 33.0);
  EXPECT_EQ(field.polygon.outline.size(), 4U);
  EXPECT_NEAR(area_m2(field.polygon), 68.68 * 111.26, 30.0);
  ASSERT_TRUE(fields->origin);
  EXPECT_NEAR(fields->origin->lat_deg, 52.0005, 1e-9);
}

TEST_F(GeoJson, LocalMetresStayAndPartsBecomeFields) {
  const auto fields = read_fields(
      file(
          R"({"type":"Feature","properties":{"id":"m","class":"orchard","crs":"local metres"},"geometry":{"type":"MultiPolygon","coordinates":[[[[0,0],[9,0],[9,9],[0,0]]],[[[20,0],[29,0],[29,9],[20,0]],[[24,1],[27,1],[27,2],[24,1]]]]}})"),
      {.class_heights_m = {{"orchard", 30.0}}});
  ASSERT_TRUE(fields.ok()) << fields.error().message;
  ASSERT_EQ(fields->fields.size(), 2U);
  EXPECT_FALSE(fields->origin);
  EXPECT_EQ(fields->fields[0].polygon.outline[1], Vec2(9, 0));
  EXPECT_EQ(fields->fields[1].polygon.holes.size(), 1U);
  EXPECT_EQ(fields->fields[1].height_m, 30.0);
  EXPECT_NE(fields->fields[0].id, fields->fields[1].id);
}

TEST_F(GeoJson, WhatIsNoFileOfFieldsIsRefused) {
  EXPECT_EQ(read_fields("/nowhere/fields.geojson", {}).error().code, Error::Code::kNotFound);
  std::ofstream(path_) << "not a vector file";
  EXPECT_THAT(read_fields(path_, {}).error().message, HasSubstr("not a vector file"));
  EXPECT_THAT(
      read_fields(
          file(R"({"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[5,52]}})"), {})
          .error()
          .message,
      HasSubstr("no polygon"));
  EXPECT_THAT(read_fields(file(kDegrees), {.origin = planner::GeoOrigin{-30.0, 100.0, 0.0}}).error().message,
              HasSubstr("a"));
}

TEST_F(GeoJson, AnEmptyPolygonStaysAFieldThatIsRefusedByName) {
  const std::string empty =
      R"({"type":"Feature","properties":{"id":"e"},"geometry":{"type":"Polygon","coordinates":[]}},)";
  const auto fields = read_fields(file(empty + kDegrees), {});
  ASSERT_TRUE(fields.ok()) << fields.error().message;
  ASSERT_EQ(fields->fields.size(), 2U);
  const FieldCut cut = cut_field(fields->fields.front(), planner::Terrain::flat(0.0), {});
  EXPECT_EQ(cut.status, FieldStatus::kRefused);
  EXPECT_THAT(cut.reason, HasSubstr("Field 'e'"));
  EXPECT_THAT(cut.reason, HasSubstr("empty"));
}

TEST_F(GeoJson, NoFlyAreasAreKeptApart) {
  const std::string no_fly =
      R"(,{"type":"Feature","properties":{"id":"pond","no_fly":true},"geometry":{"type":"Polygon","coordinates":[[[5.0002,52.0002],[5.0004,52.0002],[5.0004,52.0004],[5.0002,52.0002]]]}})";
  const auto fields = read_fields(file(kDegrees + no_fly), {});
  ASSERT_TRUE(fields.ok()) << fields.error().message;
  EXPECT_EQ(fields->fields.size(), 1U);
  ASSERT_EQ(fields->no_fly.size(), 1U);
  EXPECT_EQ(fields->no_fly[0].size(), 1U);
}

TEST_F(GeoJson, FieldsFarApartHaveAFrameEachWhenAskedTo) {
  const std::string far =
      R"(,{"type":"Feature","properties":{"id":"b"},"geometry":{"type":"Polygon","coordinates":[[[-90.0,41.0],[-89.999,41.0],[-89.999,41.001],[-90.0,41.0]]]}})";
  const std::string path = file(kDegrees + far);
  EXPECT_FALSE(read_fields(path, {}).ok());
  const auto fields = read_fields(path, {.frame = FieldFrame::kPerField});
  ASSERT_TRUE(fields.ok()) << fields.error().message;
  EXPECT_EQ(fields->origins.size(), 2U);
  for (const Field& field : fields->fields) EXPECT_LT(field.polygon.outline.front().norm(), 200.0);
}

}  // namespace
}  // namespace swallowtail::coverage
