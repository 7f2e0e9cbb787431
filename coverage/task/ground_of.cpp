#include "coverage/task/ground_of.hpp"

#include <utility>

#include "coverage/field/geojson.hpp"
#include "coverage/ground/road_file.hpp"
#include "coverage/ground/road_network.hpp"
#include "coverage/ground/rough_ground.hpp"

namespace swallowtail::coverage {
namespace {

using Travel = std::shared_ptr<const GroundTravel>;

Result<Travel> along_roads(const planner::RoadSpec& spec, double speed_mps,
                           const std::optional<planner::GeoOrigin>& origin) {
  Result<std::vector<std::vector<Vec2>>> lines = read_roads(spec.file, origin);
  if (!lines) return lines.error();
  RoadParams params;
  params.lines = std::move(*lines);
  params.speed_mps = speed_mps;
  params.off_road_speed_mps = spec.off_road_speed_mps;
  params.off_road_max_m = spec.off_road_max_m;
  const auto out = RoadNetwork::make(params);
  if (!out) return Error{out.error().code, "'" + spec.file + "': " + out.error().message};
  return Travel(*out);
}

Result<Travel> over_ground(const planner::RoughGroundSpec& spec, double speed_mps, const Box& ground,
                           const std::optional<planner::GeoOrigin>& origin, const planner::Terrain& terrain) {
  RoughGroundParams params;
  params.lo_m = ground.lo;
  params.hi_m = ground.hi;
  params.cell_m = spec.cell_m;
  params.speed_mps = speed_mps;
  params.slope_max_rad = spec.slope_max_rad;
  if (!spec.forbidden_file.empty()) {
    FieldFileOptions options;
    options.origin = origin;
    const Result<FieldFile> file = read_fields(spec.forbidden_file, options);
    if (!file) return file.error();
    for (const Field& field : file->fields) {
      const Result<std::vector<Polygon>> parts = clean(field.polygon);
      if (!parts) {
        return Error{parts.error().code,
                     "'" + spec.forbidden_file + "', '" + field.name + "': " + parts.error().message};
      }
      params.forbidden.insert(params.forbidden.end(), parts->begin(), parts->end());
    }
  }
  const auto out = RoughGround::make(params, terrain);
  if (!out) return out.error();
  return Travel(*out);
}

}  // namespace

Result<Travel> ground_of(const planner::ChargerSpec& charger, const Box& ground,
                         const std::optional<planner::GeoOrigin>& origin, const planner::Terrain& terrain) {
  if (const auto* roads = std::get_if<planner::RoadSpec>(&charger.ground))
    return along_roads(*roads, charger.speed_mps, origin);
  if (const auto* rough = std::get_if<planner::RoughGroundSpec>(&charger.ground))
    return over_ground(*rough, charger.speed_mps, ground, origin, terrain);
  return Travel();
}

}  // namespace swallowtail::coverage
