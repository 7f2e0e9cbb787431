#include "planner/scenario/load.hpp"

#include <algorithm>
#include <cmath>

#include "planner/world/raster_file.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kCellsPerSpan =
    200.0;  // ours: a default raster of at most about this many cells along the longer side …
constexpr double kCellsPerSigma = 4.0;  // … unless the narrowest mountain needs finer ones
constexpr double kMaxCellsPerSpan = 2000.0;

double default_cell_size_m(const MountainTerrain& spec, double span_m) {
  double cell_m = span_m / kCellsPerSpan;
  for (const Mountain& mountain : spec.mountains)
    cell_m = std::min(cell_m, std::sqrt(mountain.spread_m2 / 2.0) / kCellsPerSigma);
  return std::max(cell_m, span_m / kMaxCellsPerSpan);
}

}  // namespace

Result<Terrain> load_terrain(const Scenario& scenario) {
  if (const auto* flat = std::get_if<FlatTerrain>(&scenario.terrain)) return Terrain::flat(flat->elevation_m);
  if (const auto* spec = std::get_if<MountainTerrain>(&scenario.terrain)) {
    const Vec2 lo = scenario.bounds.min_m.head<2>();
    const Vec2 hi = scenario.bounds.max_m.head<2>();
    return mountains_terrain(spec->mountains, lo, hi,
                             spec->cell_size_m.value_or(default_cell_size_m(*spec, (hi - lo).maxCoeff())));
  }
  const auto& raster = std::get<RasterTerrain>(scenario.terrain);
  RasterOptions options;
  options.origin = scenario.origin;
  options.no_data_elevation_m = raster.no_data_elevation_m;
  return read_terrain(raster.file, options);
}

Result<std::shared_ptr<const World>> load_world(const Scenario& scenario) {
  auto terrain = load_terrain(scenario);
  if (!terrain) return terrain.error();
  return World::make(std::move(*terrain), scenario.obstacles, scenario.bounds);
}

Vec3 start_position_m(const Scenario& scenario, const Terrain& terrain) {
  if (scenario.start_m) return *scenario.start_m;
  const Vec2 site =
      scenario.coverage ? scenario.coverage->charger.start_m : Vec2(scenario.bounds.min_m.head<2>());
  return {site.x(), site.y(), terrain.height_at(site.x(), site.y())};
}

}  // namespace swallowtail::planner
