#include "planner/world/raster_file.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>

#include <utility>
#include <vector>

#include "planner/world/detail/projection.hpp"
#include "planner/world/detail/raster_source.hpp"

namespace swallowtail::planner {
namespace {

Error write_error(const std::string& path) {
  return bad_input(fmt::format("The raster '{}' cannot be written: {}.", path, detail::last_gdal_message()));
}

Status place(GDALDataset& dataset, const std::string& path, const TerrainGrid& grid,
             const std::optional<GeoOrigin>& origin) {
  const double half = 0.5 * grid.cell_size_m;
  double transform[6] = {grid.origin_m.x() - half,
                         grid.cell_size_m,
                         0.0,
                         grid.origin_m.y() + (grid.rows - 1) * grid.cell_size_m + half,
                         0.0,
                         -grid.cell_size_m};
  if (dataset.SetGeoTransform(transform) != CE_None) return write_error(path);
  if (!origin) return {};
  const auto frame = detail::local_frame(*origin);
  if (!frame) return frame.error();
  if (dataset.SetSpatialRef(&frame.value()) != CE_None) return write_error(path);
  return {};
}

}  // namespace

Result<Terrain> read_terrain(const std::string& path, const RasterOptions& options) {
  const detail::QuietGdal quiet;
  auto source = detail::read_source(path, options);
  if (!source) return source.error();
  auto grid = options.origin ? detail::as_local(path, *source, *options.origin, options.max_samples)
                             : detail::as_own_metres(path, *source);
  if (!grid) return grid.error();
  auto terrain = Terrain::from_grid(std::move(*grid));
  if (!terrain)
    return bad_input(fmt::format("The raster '{}' is refused. {}", path, terrain.error().message));
  return terrain;
}

Status write_terrain(const std::string& path, const TerrainGrid& grid,
                     const std::optional<GeoOrigin>& origin) {
  if (auto checked = Terrain::from_grid(grid); !checked) return checked.error();
  const detail::QuietGdal quiet;
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  if (driver == nullptr) return internal_error("GDAL has no GeoTIFF driver.");
  std::vector<float> rows_from_north;
  rows_from_north.reserve(grid.elevation_m.size());
  const auto added = static_cast<float>(origin ? origin->elevation_m : 0.0);
  for (int r = grid.rows - 1; r >= 0; --r) {
    for (int c = 0; c < grid.cols; ++c) {
      rows_from_north.push_back(
          grid.elevation_m[static_cast<std::size_t>(r) * static_cast<std::size_t>(grid.cols) +
                           static_cast<std::size_t>(c)] +
          added);
    }
  }
  const char* const options[] = {"COMPRESS=DEFLATE", nullptr};
  GDALDatasetUniquePtr dataset(
      driver->Create(path.c_str(), grid.cols, grid.rows, 1, GDT_Float32, const_cast<char**>(options)));
  if (!dataset) return write_error(path);
  if (Status status = place(*dataset, path, grid, origin); !status) return status;
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  if (band.RasterIO(GF_Write, 0, 0, grid.cols, grid.rows, rows_from_north.data(), grid.cols, grid.rows,
                    GDT_Float32, 0, 0, nullptr) != CE_None) {
    return write_error(path);
  }
  CPLErrorReset();
  dataset.reset();
  if (CPLGetLastErrorType() >= CE_Failure) return write_error(path);
  return {};
}

}  // namespace swallowtail::planner
