#include "coverage/field/geojson.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <utility>
#include <vector>

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

/// Written by GDAL itself, as a user's other programs do.
void write_square(const std::string& driver, const std::string& path, int epsg, double x, double y) {
  GDALAllRegister();
  GDALDriver* writer = GetGDALDriverManager()->GetDriverByName(driver.c_str());
  ASSERT_NE(writer, nullptr) << driver;
  GDALDataset* dataset = writer->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
  ASSERT_NE(dataset, nullptr) << path;
  OGRSpatialReference reference;
  reference.importFromEPSG(epsg);
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRLayer* layer = dataset->CreateLayer("fields", epsg == 0 ? nullptr : &reference, wkbPolygon, nullptr);
  OGRFieldDefn name("id", OFTString);
  layer->CreateField(&name);
  const double size = epsg == 4326 ? 0.001 : 100.0;
  OGRLinearRing ring;
  for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}, {0, 0}})
    ring.addPoint(x + dx * size, y + dy * size);
  OGRPolygon polygon;
  polygon.addRing(&ring);
  OGRFeature feature(layer->GetLayerDefn());
  feature.SetField("id", "square");
  feature.SetGeometry(&polygon);
  EXPECT_EQ(layer->CreateFeature(&feature), OGRERR_NONE);
  GDALClose(dataset);
}

struct Projected {
  const char* driver;
  const char* file;
  int epsg;
  double x;
  double y;
};

TEST(VectorFiles, InAnyProjectionAreTheSameField) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("swallowtail_vectors_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  for (const Projected& one : {Projected{"ESRI Shapefile", "rd.shp", 28992, 155000, 463000},
                               Projected{"ESRI Shapefile", "nztm.shp", 2193, 1570000, 5180000},
                               Projected{"GPKG", "utm.gpkg", 32631, 637000, 5763000},
                               Projected{"GML", "gk.gml", 31466, 2570000, 5650000}}) {
    const std::string path = folder / one.file;
    write_square(one.driver, path, one.epsg, one.x, one.y);
    const auto file = read_fields(path, {});
    ASSERT_TRUE(file.ok()) << one.file << ": " << file.error().message;
    ASSERT_EQ(file->fields.size(), 1U) << one.file;
    EXPECT_NEAR(area_m2(file->fields[0].polygon), 1e4, 12.0) << one.file;
    EXPECT_TRUE(file->origin) << one.file;
  }
  std::filesystem::remove_all(folder);
}

/// A square of 0.002° at a place, as a feature.
std::string square_at(const std::string& properties, double west, double east, double south, double north) {
  std::ostringstream out;
  out << std::setprecision(12) << R"({"type":"Feature","properties":{)" << properties
      << R"(},"geometry":{"type":"Polygon","coordinates":[[[)" << west << ',' << south << "],[" << east << ','
      << south << "],[" << east << ',' << north << "],[" << west << ',' << north << "],[" << west << ','
      << south << "]]]}}";
  return out.str();
}

TEST_F(GeoJson, FieldsOnThe180thMeridianAreWholeAndTogether) {
  const double area = 0.002 * 111'320.0 * std::cos(0.29322) * 0.002 * 110'600.0;
  const std::vector<std::pair<double, double>> ways_to_say = {{179.999, -179.999}, {179.999, 180.001}};
  for (const auto& [west, east] : ways_to_say) {
    const auto read = read_fields(file(square_at(R"("id":"a")", west, east, -16.801, -16.799)), {});
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_NEAR(area_m2(read->fields[0].polygon), area, 0.01 * area);
    EXPECT_NEAR(std::abs(read->origin->lon_deg), 180.0, 1e-9);
  }
  const auto halves = read_fields(file(square_at(R"("id":"a")", 179.999, 180.0, -16.801, -16.799) + "," +
                                       square_at(R"("id":"b")", -180.0, -179.999, -16.801, -16.799)),
                                  {});
  ASSERT_TRUE(halves.ok()) << halves.error().message;
  EXPECT_NEAR(halves->fields[1].polygon.outline[0].x(), halves->fields[0].polygon.outline[1].x(), 1e-6);
}

TEST_F(GeoJson, LatitudeFirstIsSaidSo) {
  const auto read = read_fields(file(square_at(R"("id":"a")", -43.5, -43.499, 172.6, 172.601)), {});
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message, HasSubstr("latitude and longitude the wrong way round"));
}

TEST_F(GeoJson, ANoFlyAreaLargerThanTheCountryAroundIsNotLeftOut) {
  const std::string field = square_at(R"("id":"a")", 5.0, 5.002, 52.0, 52.002);
  const auto zone =
      read_fields(file(field + "," + square_at(R"("id":"ctr","no_fly":true)", 4.5, 5.5, 51.6, 52.4)), {});
  ASSERT_TRUE(zone.ok()) << zone.error().message;
  ASSERT_EQ(zone->no_fly[0].size(), 1U);
  EXPECT_TRUE(contains(zone->no_fly[0][0], zone->fields[0].polygon.outline[0]));
  const auto country =
      read_fields(file(field + "," + square_at(R"("id":"fir","no_fly":true)", 0, 11, 48, 55)), {});
  ASSERT_FALSE(country.ok());
  EXPECT_THAT(country.error().message, HasSubstr("No-fly area 'fir'"));
  const auto elsewhere =
      read_fields(file(field + "," + square_at(R"("id":"fir","no_fly":true)", 20, 31, 48, 55)), {});
  ASSERT_TRUE(elsewhere.ok()) << elsewhere.error().message;
  EXPECT_TRUE(elsewhere->no_fly[0].empty());
}

TEST_F(GeoJson, AnArchiveMayHoldItsFilesInFolders) {
  const std::string text = R"({"type":"FeatureCollection","features":[)" + std::string(kDegrees) + "]}";
  const std::string path = path_ + ".ZIP";
  const auto add = [&](const std::string& name, const std::string& content) {
    VSILFILE* out = VSIFOpenL(("/vsizip/{" + path + "}/" + name).c_str(), "wb");
    ASSERT_NE(out, nullptr);
    VSIFWriteL(content.data(), 1, content.size(), out);
    VSIFCloseL(out);
  };
  add("export/2026/fields.geojson", text);
  add("__MACOSX/export/2026/._fields.geojson", text);
  const auto read = read_fields(path, {});
  std::filesystem::remove(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->fields.size(), 1U);
}

TEST(VectorFiles, WithoutAProjectionAreLocalMetresOrRefused) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("swallowtail_bare_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  write_square("ESRI Shapefile", folder / "local.shp", 0, 10, 20);
  const auto local = read_fields(folder / "local.shp", {});
  ASSERT_TRUE(local.ok()) << local.error().message;
  EXPECT_FALSE(local->origin);
  write_square("ESRI Shapefile", folder / "utm.shp", 0, 637000, 5763000);
  EXPECT_THAT(read_fields(folder / "utm.shp", {}).error().message, HasSubstr("names no coordinate system"));
  write_square("ESRI Shapefile", folder / "degrees.shp", 4326, 5, 52);
  std::filesystem::remove(folder / "degrees.prj");
  EXPECT_THAT(read_fields(folder / "degrees.shp", {}).error().message, HasSubstr("seem to be in degrees"));
  std::filesystem::remove_all(folder);
}

TEST(VectorFiles, LinesOfWktShareAFrameAndCurvesAreStraightened) {
  const std::string path =
      std::filesystem::temp_directory_path() / ("swallowtail_lines_" + std::to_string(getpid()) + ".wkt");
  std::ofstream(path)
      << "POLYGON((0 0,100 0,100 60,0 60,0 0))\n"
         "POLYGON((200 0,300 0,300 60,200 60,200 0))\n"
         "MULTIPOLYGON EMPTY\n"
         "CURVEPOLYGON(COMPOUNDCURVE(CIRCULARSTRING(1000 0,1050 50,1100 0),(1100 0,1000 0)))\n";
  const auto file = read_fields(path, {});
  ASSERT_TRUE(file.ok()) << file.error().message;
  ASSERT_EQ(file->fields.size(), 4U);
  EXPECT_FALSE(file->origin);
  EXPECT_TRUE(file->fields[2].polygon.outline.empty());
  EXPECT_NEAR(area_m2(file->fields[3].polygon), 3927.0, 10.0);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace swallowtail::coverage
