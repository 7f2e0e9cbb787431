#include "planner/world/raster_file.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

namespace swallowtail::planner {
namespace {

using testing::HasSubstr;

const GeoOrigin kOrigin{52.0, 10.0, 40.0};

/// A raster written with GDAL directly, then read by the code under test.
struct File {
  std::array<double, 6> transform = {0.0, 2.0, 0.0, 0.0, 0.0, -2.0};
  std::optional<int> epsg = 32632;
  std::optional<double> no_data;
  std::string unit;
  double scale = 1.0;
  std::vector<float> rows_from_top = {7, 8, 9, 4, 5, 6, 1, 2, 3};
};

class RasterFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("swallowtail_raster_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    GDALAllRegister();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& file) const { return (folder_ / file).string(); }

  std::string write(const File& file) const {
    const std::string to = path("in.tif");
    GDALDatasetUniquePtr dataset(
        GetGDALDriverManager()->GetDriverByName("GTiff")->Create(to.c_str(), 3, 3, 1, GDT_Float32, nullptr));
    auto transform = file.transform;
    dataset->SetGeoTransform(transform.data());
    if (file.epsg) {
      OGRSpatialReference reference;
      reference.importFromEPSG(*file.epsg);
      dataset->SetSpatialRef(&reference);
    }
    GDALRasterBand& band = *dataset->GetRasterBand(1);
    if (file.no_data) band.SetNoDataValue(*file.no_data);
    if (!file.unit.empty()) band.SetUnitType(file.unit.c_str());
    if (file.scale != 1.0) band.SetScale(file.scale);
    auto values = file.rows_from_top;
    EXPECT_EQ(band.RasterIO(GF_Write, 0, 0, 3, 3, values.data(), 3, 3, GDT_Float32, 0, 0, nullptr), CE_None);
    return to;
  }

  std::string refusal(const File& file, const RasterOptions& options = {}) const {
    const auto terrain = read_terrain(write(file), options);
    return terrain.ok() ? "accepted" : terrain.error().message;
  }

  std::filesystem::path folder_;
};

TEST_F(RasterFile, OwnMetresStandSouthWestFirst) {
  const auto terrain = read_terrain(write({}), {});
  ASSERT_TRUE(terrain.ok()) << terrain.error().message;
  EXPECT_EQ(terrain->grid()->cell_size_m, 2.0);
  EXPECT_EQ(terrain->grid()->elevation_m, (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(terrain->grid()->origin_m, Vec2(0, 0));
}

TEST_F(RasterFile, SouthUpAndMirroredFilesAreTurnedRight) {
  File south_up;
  south_up.transform = {0.0, 2.0, 0.0, 0.0, 0.0, 2.0};
  south_up.rows_from_top = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const auto turned = read_terrain(write(south_up), {});
  ASSERT_TRUE(turned.ok()) << turned.error().message;
  EXPECT_EQ(turned->grid()->elevation_m, (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  File mirrored;
  mirrored.transform = {0.0, -2.0, 0.0, 0.0, 0.0, -2.0};
  const auto unmirrored = read_terrain(write(mirrored), {});
  ASSERT_TRUE(unmirrored.ok()) << unmirrored.error().message;
  EXPECT_EQ(unmirrored->grid()->elevation_m, (std::vector<float>{3, 2, 1, 6, 5, 4, 9, 8, 7}));
}

TEST_F(RasterFile, GapsAreCountedOrFilled) {
  File file;
  file.no_data = -3.4e38;
  file.rows_from_top = {7, 8, -3.4e38F, 4, std::nanf(""), 6, 1, 2, 3};
  EXPECT_THAT(refusal(file), HasSubstr("no data in 2 of 9 samples"));
  RasterOptions options;
  options.no_data_elevation_m = -1.5;
  const auto terrain = read_terrain(write(file), options);
  ASSERT_TRUE(terrain.ok()) << terrain.error().message;
  EXPECT_EQ(terrain->grid()->elevation_m, (std::vector<float>{1, 2, 3, 4, -1.5, 6, 7, 8, -1.5}));
}

TEST_F(RasterFile, UnitsAndScaleAreApplied) {
  File feet;
  feet.unit = "ft";
  EXPECT_NEAR(read_terrain(write(feet), {})->height_at(0, 0), 0.3048, 1e-6);
  File decimetres;
  decimetres.scale = 0.1;
  EXPECT_NEAR(read_terrain(write(decimetres), {})->height_at(0, 0), 0.1, 1e-6);
  File odd;
  odd.unit = "furlong";
  EXPECT_THAT(refusal(odd), HasSubstr("'furlong'"));
}

TEST_F(RasterFile, RefusalsNameTheFileAndTheReason) {
  File rotated;
  rotated.transform = {0.0, 2.0, 0.3, 0.0, 0.3, -2.0};
  EXPECT_THAT(refusal(rotated), testing::AllOf(HasSubstr("in.tif"), HasSubstr("rotated")));
  File oblong;
  oblong.transform = {0.0, 2.0, 0.0, 0.0, 0.0, -3.0};
  EXPECT_THAT(refusal(oblong), HasSubstr("not square"));
  File degrees;
  degrees.epsg = 4326;
  EXPECT_THAT(refusal(degrees), HasSubstr("degrees"));
  File nowhere;
  nowhere.epsg = std::nullopt;
  EXPECT_THAT(refusal(nowhere, {kOrigin, std::nullopt, 5e7}), HasSubstr("no coordinate system"));
  EXPECT_THAT(refusal({}, {std::nullopt, std::nullopt, 8.0}), HasSubstr("9 samples"));
  File high;
  high.rows_from_top[4] = 2e4F;
  EXPECT_THAT(refusal(high), testing::AllOf(HasSubstr("in.tif"), HasSubstr("elevation")));
  EXPECT_THAT(read_terrain(path("none.tif"), {}).error().message, HasSubstr("is not a file"));
  EXPECT_FALSE(read_terrain("/vsicurl/http://127.0.0.1:9/x.tif", {}).ok());
  std::ofstream(path("text.tif")) << "not a raster";
  EXPECT_THAT(read_terrain(path("text.tif"), {}).error().message, HasSubstr("cannot be read"));
}

TEST_F(RasterFile, FarFromTheOriginIsRefused) {
  File file;
  file.transform = {500000.0, 2.0, 0.0, 5800000.0, 0.0, -2.0};
  EXPECT_EQ(refusal(file, {GeoOrigin{52.3, 9.0, 0.0}, std::nullopt, 5e7}), "accepted");
  EXPECT_THAT(refusal(file, {GeoOrigin{-10.0, 105.0, 0.0}, std::nullopt, 5e7}),
              testing::AnyOf(HasSubstr("km from the origin"), HasSubstr("cannot be projected")));
  EXPECT_THAT(refusal(file, {GeoOrigin{95.0, 9.0, 0.0}, std::nullopt, 5e7}), HasSubstr("origin"));
}

TEST_F(RasterFile, ARotatedFileIsResampledToThePlaneItHolds) {
  // A plane z = x east + 2 y north over a turned grid in UTM: bilinear resampling keeps a plane.
  const double turn = 0.4;
  File file;
  const Vec2 corner(500000.0, 5761000.0);
  file.transform = {corner.x(), 2 * std::cos(turn), 2 * std::sin(turn),
                    corner.y(), 2 * std::sin(turn), -2 * std::cos(turn)};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      const double east = file.transform[1] * (c + 0.5) + file.transform[2] * (r + 0.5);
      const double north = file.transform[4] * (c + 0.5) + file.transform[5] * (r + 0.5);
      file.rows_from_top[static_cast<std::size_t>(3 * r + c)] = static_cast<float>(20.0 + east + 2.0 * north);
    }
  }
  const double centre_east = file.transform[1] * 1.5 + file.transform[2] * 1.5;
  const double centre_north = file.transform[4] * 1.5 + file.transform[5] * 1.5;
  // Around the centre sample itself; zone 32's central meridian, so north is north.
  OGRSpatialReference utm;
  utm.importFromEPSG(32632);
  utm.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRSpatialReference wgs;
  wgs.SetWellKnownGeogCS("WGS84");
  wgs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  double lon = corner.x() + centre_east;
  double lat = corner.y() + centre_north;
  OGRCoordinateTransformation* transform = OGRCreateCoordinateTransformation(&utm, &wgs);
  ASSERT_TRUE(transform->Transform(1, &lon, &lat));
  OGRCoordinateTransformation::DestroyCT(transform);
  const auto terrain = read_terrain(write(file), {GeoOrigin{lat, lon, 5.0}, std::nullopt, 5e7});
  ASSERT_TRUE(terrain.ok()) << terrain.error().message;
  const double at_centre = 20.0 + centre_east + 2.0 * centre_north - 5.0;
  EXPECT_NEAR(terrain->height_at(0, 0), at_centre, 0.1);
  EXPECT_NEAR(terrain->height_at(1, 0) - terrain->height_at(0, 0), 1.0, 0.25);
  EXPECT_NEAR(terrain->height_at(0, 1) - terrain->height_at(0, 0), 2.0, 0.25);
}

TEST_F(RasterFile, WrittenTerrainReadsBackTheSame) {
  TerrainGrid grid{Vec2(-6.0, 4.0), 2.5, 4, 3, {}};
  for (int i = 0; i < 12; ++i) grid.elevation_m.push_back(static_cast<float>(i * i) * 0.25F);
  const std::string plain = path("plain.tif");
  ASSERT_TRUE(write_terrain(plain, grid, std::nullopt).ok());
  const auto back = read_terrain(plain, {});
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->grid()->elevation_m, grid.elevation_m);
  EXPECT_EQ(back->grid()->cell_size_m, 2.5);

  const std::string placed = path("placed.tif");
  ASSERT_TRUE(write_terrain(placed, grid, kOrigin).ok());
  const auto around = read_terrain(placed, {kOrigin, std::nullopt, 5e7});
  ASSERT_TRUE(around.ok()) << around.error().message;
  ASSERT_EQ(around->grid()->rows, 4);
  ASSERT_EQ(around->grid()->cols, 3);
  EXPECT_LT((around->grid()->origin_m - grid.origin_m).norm(), 1e-3);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(around->grid()->elevation_m[i], grid.elevation_m[i], 2e-3);
}

TEST_F(RasterFile, UnwritablePlacesAndBadGridsAreErrors) {
  const TerrainGrid grid{Vec2::Zero(), 1.0, 2, 2, {0, 0, 0, 0}};
  EXPECT_THAT(write_terrain(path("no/such/folder/x.tif"), grid, std::nullopt).error().message,
              HasSubstr("cannot be written"));
  EXPECT_FALSE(write_terrain(path("x.tif"), {Vec2::Zero(), 1.0, 2, 2, {0, 0, 0}}, std::nullopt).ok());
}

TEST(LocalFrame, GoesThereAndBack) {
  for (const auto& [lat, lon] : {std::pair{52.0, 10.0}, std::pair{52.05, 10.08}, std::pair{51.9, 9.7}}) {
    const auto local = to_local(kOrigin, lat, lon);
    ASSERT_TRUE(local.ok()) << local.error().message;
    const auto back = to_geodetic(kOrigin, *local);
    ASSERT_TRUE(back.ok());
    EXPECT_NEAR(back->x(), lat, 1e-10);
    EXPECT_NEAR(back->y(), lon, 1e-10);
  }
  EXPECT_LT(to_local(kOrigin, 52.0, 10.0)->norm(), 1e-6);
}

TEST(LocalFrame, HasTheLengthsOfTheEllipsoid) {
  // One arc minute of the meridian (radius M) and of the parallel (radius N cos φ), by the closed formulas.
  const double minute = 1.0 / 60.0;
  const double radians = minute * M_PI / 180.0;
  const double a = 6378137.0;
  const double e2 = 0.00669437999014;
  const double s = std::sin(52.0 * M_PI / 180.0);
  const double n = a / std::sqrt(1.0 - e2 * s * s);
  const double m = n * (1.0 - e2) / (1.0 - e2 * s * s);
  EXPECT_NEAR(to_local(kOrigin, 52.0 + minute, 10.0)->y(), m * radians, 0.05);
  EXPECT_NEAR(to_local(kOrigin, 52.0, 10.0 + minute)->x(), n * std::cos(52.0 * M_PI / 180.0) * radians, 0.05);
  EXPECT_GT(to_local(kOrigin, 52.01, 10.0)->y(), 0.0);
  EXPECT_GT(to_local(kOrigin, 52.0, 10.01)->x(), 0.0);
}

TEST(LocalFrame, RefusesWhatIsNoPlace) {
  EXPECT_FALSE(to_local(kOrigin, 91.0, 0.0).ok());
  EXPECT_FALSE(to_local(kOrigin, std::nan(""), 0.0).ok());
  EXPECT_FALSE(to_local({100.0, 0.0, 0.0}, 0.0, 0.0).ok());
  EXPECT_FALSE(to_geodetic(kOrigin, Vec2(std::nan(""), 0.0)).ok());
}

}  // namespace
}  // namespace swallowtail::planner
