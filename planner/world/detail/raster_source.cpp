#include "planner/world/detail/raster_source.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "planner/base/checks.hpp"
#include "planner/world/detail/projection.hpp"

namespace swallowtail::planner::detail {
namespace {

/// Metres in a band's unit; none if it is not a length that we know.
std::optional<double> metres_per_unit(const std::string& unit) {
  if (unit.empty() || unit == "m" || unit == "metre" || unit == "meter" || unit == "metres" ||
      unit == "meters")
    return 1.0;
  if (unit == "ft" || unit == "foot" || unit == "feet") return 0.3048;
  if (unit == "sfoot" || unit == "us-ft" || unit == "US survey foot") return 1200.0 / 3937.0;
  return std::nullopt;
}

Error file_error(const std::string& path, const std::string& what) {
  return bad_input(fmt::format("The raster '{}' {}.", path, what));
}

Status read_georeference(const std::string& path, GDALDataset& dataset, RasterSource& source) {
  if (dataset.GetGeoTransform(source.transform.g) != CE_None) return file_error(path, "has no georeference");
  const bool finite = std::all_of(std::begin(source.transform.g), std::end(source.transform.g),
                                  [](double v) { return is_finite(v); });
  if (!finite || !(std::abs(source.transform.determinant()) > 0.0))
    return file_error(path, "has a georeference that maps all cells to one line");
  const OGRSpatialReference* named = dataset.GetSpatialRef();
  if (named == nullptr || named->IsEmpty()) return {};
  auto reference = std::make_shared<OGRSpatialReference>(*named);
  reference->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  source.reference = std::move(reference);
  return {};
}

/// Fills every gap, or counts them.
Status fill_gaps(const std::string& path, GDALRasterBand& band, const RasterOptions& options,
                 RasterSource& source) {
  std::vector<std::uint8_t> mask(source.elevation_m.size(), 255);
  if ((band.GetMaskFlags() & GMF_ALL_VALID) == 0 &&
      band.GetMaskBand()->RasterIO(GF_Read, 0, 0, source.cols, source.rows, mask.data(), source.cols,
                                   source.rows, GDT_Byte, 0, 0, nullptr) != CE_None) {
    return file_error(path, "has a mask that cannot be read: " + last_gdal_message());
  }
  std::size_t gaps = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] != 0 && std::isfinite(source.elevation_m[i])) continue;
    ++gaps;
    source.elevation_m[i] = static_cast<float>(options.no_data_elevation_m.value_or(0.0));
  }
  if (gaps > 0 && !options.no_data_elevation_m) {
    return file_error(
        path, fmt::format("has no data in {} of {} samples, and no elevation was given for those", gaps,
                          mask.size()));
  }
  return {};
}

Status scale_to_metres(const std::string& path, GDALRasterBand& band, std::vector<float>& elevation_m) {
  const auto unit = metres_per_unit(band.GetUnitType());
  if (!unit)
    return file_error(path, fmt::format("has elevations in '{}', which is not known; metres or feet are",
                                        band.GetUnitType()));
  const double scale = band.GetScale() * *unit;
  const double offset = band.GetOffset() * *unit;
  if (scale == 1.0 && offset == 0.0) return {};
  for (float& z : elevation_m) z = static_cast<float>(static_cast<double>(z) * scale + offset);
  return {};
}

}  // namespace

double RasterSource::at(double col, double row) const {
  const double c = std::clamp(col, 0.0, cols - 1.0);
  const double r = std::clamp(row, 0.0, rows - 1.0);
  const int c0 = std::clamp(static_cast<int>(c), 0, cols - 2);
  const int r0 = std::clamp(static_cast<int>(r), 0, rows - 2);
  const float* upper = elevation_m.data() + static_cast<std::ptrdiff_t>(r0) * cols + c0;
  const float* lower = upper + cols;
  const double fc = c - c0;
  const double fr = r - r0;
  return (1.0 - fr) * ((1.0 - fc) * upper[0] + fc * upper[1]) + fr * ((1.0 - fc) * lower[0] + fc * lower[1]);
}

Result<RasterSource> read_source(const std::string& path, const RasterOptions& options) {
  std::error_code ignored;
  // GDAL would also take URLs, connection strings and inline descriptions: only files are meant.
  if (!std::filesystem::is_regular_file(path, ignored))
    return not_found(fmt::format("The raster '{}' is not a file.", path));
  if (options.no_data_elevation_m && !is_within(*options.no_data_elevation_m, -1e4, 1e4)) {
    return bad_input(fmt::format("The elevation for no data is {} m; it must lie within ±10000 m.",
                                 *options.no_data_elevation_m));
  }
  GDALAllRegister();
  const GDALDatasetUniquePtr dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (!dataset || dataset->GetRasterCount() < 1)
    return file_error(path, "cannot be read: " + last_gdal_message());
  RasterSource source;
  source.rows = dataset->GetRasterYSize();
  source.cols = dataset->GetRasterXSize();
  if (source.rows < 2 || source.cols < 2)
    return file_error(path,
                      fmt::format("has {} × {} samples; it needs at least 2 × 2", source.rows, source.cols));
  const double count = static_cast<double>(source.rows) * source.cols;
  if (!(count <= options.max_samples)) {
    return file_error(
        path, fmt::format("has {:.0f} samples; at most {:.0f} are allowed", count, options.max_samples));
  }
  if (Status status = read_georeference(path, *dataset, source); !status) return status.error();
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  if (GDALDataTypeIsComplex(band.GetRasterDataType()) != 0) return file_error(path, "holds complex numbers");
  source.elevation_m.resize(static_cast<std::size_t>(count));
  if (band.RasterIO(GF_Read, 0, 0, source.cols, source.rows, source.elevation_m.data(), source.cols,
                    source.rows, GDT_Float32, 0, 0, nullptr) != CE_None) {
    return file_error(path, "cannot be read: " + last_gdal_message());
  }
  // Scaled first: what stands for no data is in metres already.
  if (Status status = scale_to_metres(path, band, source.elevation_m); !status) return status.error();
  if (Status status = fill_gaps(path, band, options, source); !status) return status.error();
  return source;
}

Result<TerrainGrid> as_own_metres(const std::string& path, const RasterSource& source) {
  const auto& g = source.transform.g;
  if (source.reference) {
    if (source.reference->IsGeographic() != 0)
      return file_error(path, "is in degrees; give an origin to project it around");
    if (const double unit = source.reference->GetLinearUnits(); std::abs(unit - 1.0) > 1e-9) {
      return file_error(
          path, fmt::format("has coordinates in units of {} m; give an origin to project it around", unit));
    }
  }
  if (std::abs(g[2]) > 1e-9 * std::abs(g[1]) || std::abs(g[4]) > 1e-9 * std::abs(g[5])) {
    return file_error(path, "is rotated; give an origin to resample it around");
  }
  if (std::abs(std::abs(g[1]) - std::abs(g[5])) > 1e-6 * std::abs(g[1])) {
    return file_error(path,
                      fmt::format("has cells of {} × {} m, not square; give an origin to resample it around",
                                  std::abs(g[1]), std::abs(g[5])));
  }
  TerrainGrid grid{Vec2::Zero(), std::abs(g[1]), source.rows, source.cols, {}};
  grid.elevation_m.reserve(source.elevation_m.size());
  for (int r = 0; r < grid.rows; ++r) {
    const int from_row = g[5] > 0.0 ? r : grid.rows - 1 - r;
    for (int c = 0; c < grid.cols; ++c) {
      const int from_col = g[1] > 0.0 ? c : grid.cols - 1 - c;
      grid.elevation_m.push_back(
          source.elevation_m[static_cast<std::size_t>(from_row) * static_cast<std::size_t>(grid.cols) +
                             static_cast<std::size_t>(from_col)]);
    }
  }
  return grid;
}

}  // namespace swallowtail::planner::detail
