#include "coverage/task/ground_of.hpp"

#include <utility>

#include "coverage/field/geojson.hpp"
#include "coverage/ground/road_file.hpp"
#include "coverage/ground/road_network.hpp"
#include "coverage/ground/rough_ground.hpp"

namespace swallowtail::coverage {
namespace {

using Travel = std::shared_ptr<const GroundTravel>;

Result<std::vector<Polygon>> read_closed(const std::string& path,
                                         const std::optional<planner::GeoOrigin>& origin) {
  FieldFileOptions options;
  options.origin = origin;
  const Result<FieldFile> file = read_fields(path, options);
  if (!file) return file.error();
  std::vector<Polygon> out;
  for (const Field& field : file->fields) {
    const Result<std::vector<Polygon>> parts = clean(field.polygon);
    if (!parts) {
      return Error{parts.error().code, "'" + path + "', '" + field.name + "': " + parts.error().message};
    }
    out.insert(out.end(), parts->begin(), parts->end());
  }
  return out;
}

Result<Travel> along_roads(const planner::RoadSpec& spec, double speed_mps,
                           std::vector<std::vector<Vec2>> lines) {
  RoadParams params;
  params.lines = std::move(lines);
  params.speed_mps = speed_mps;
  params.off_road_speed_mps = spec.off_road_speed_mps;
  params.off_road_max_m = spec.off_road_max_m;
  const auto out = RoadNetwork::make(params);
  if (!out) return Error{out.error().code, "'" + spec.file + "': " + out.error().message};
  return Travel(*out);
}

Result<Travel> over_ground(const planner::RoughGroundSpec& spec, double speed_mps, const Box& ground,
                           std::vector<Polygon> closed, const planner::Terrain& terrain) {
  RoughGroundParams params;
  params.lo_m = ground.lo;
  params.hi_m = ground.hi;
  params.cell_m = spec.cell_m;
  params.speed_mps = speed_mps;
  params.slope_max_rad = spec.slope_max_rad;
  params.forbidden = std::move(closed);
  const auto out = RoughGround::make(params, terrain);
  if (!out) return out.error();
  return Travel(*out);
}

}  // namespace

Result<RobotGround> read_robot_ground(const planner::ChargerSpec& charger,
                                      const std::optional<planner::GeoOrigin>& origin) {
  RobotGround out;
  if (const auto* roads = std::get_if<planner::RoadSpec>(&charger.ground)) {
    auto lines = read_roads(roads->file, origin);
    if (!lines) return lines.error();
    out.roads = std::move(*lines);
  }
  const auto* rough = std::get_if<planner::RoughGroundSpec>(&charger.ground);
  if (rough != nullptr && !rough->forbidden_file.empty()) {
    auto closed = read_closed(rough->forbidden_file, origin);
    if (!closed) return closed.error();
    out.closed = std::move(*closed);
  }
  return out;
}

Result<Travel> ground_of(const planner::ChargerSpec& charger, const Box& ground,
                         const std::optional<planner::GeoOrigin>& origin, const planner::Terrain& terrain) {
  auto read = read_robot_ground(charger, origin);
  if (!read) return read.error();
  if (const auto* roads = std::get_if<planner::RoadSpec>(&charger.ground))
    return along_roads(*roads, charger.speed_mps, std::move(read->roads));
  if (const auto* rough = std::get_if<planner::RoughGroundSpec>(&charger.ground))
    return over_ground(*rough, charger.speed_mps, ground, std::move(read->closed), terrain);
  return Travel();
}

}  // namespace swallowtail::coverage
