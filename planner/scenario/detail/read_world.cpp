#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "planner/scenario/detail/read_parts.hpp"

namespace swallowtail::planner::detail {
namespace {

using Kind = ScenarioError::Kind;

constexpr Range kCoordinate = from_to(-kMaxXy_m, kMaxXy_m);
constexpr Range kElevation = from_to(-1e3, 1e4);
constexpr Range kSize = above_to(0, kMaxSize_m);
constexpr std::size_t kMaxObstacles = 10'000;
constexpr std::size_t kMaxMountains = 1'000;
constexpr std::size_t kMinMeshVertices = 4;
constexpr std::size_t kMaxMeshVertices = 256;

bool read_mesh(Section& section, ConvexMesh& mesh, Vec3& position) {
  bool ok = !section.has("yaw_deg") ||
            section.angle_deg("yaw_deg", Need::kOptional, from_to(-360, 360), mesh.yaw_rad);
  ok = (!section.has("center_m") || section.vector("center_m", Need::kOptional, kCoordinate, position)) && ok;
  const auto items = section.list("vertices_m", Need::kRequired, kMinMeshVertices, kMaxMeshVertices);
  for (const Section::Item& item : items) {
    Vec3 vertex = Vec3::Zero();
    ok = Section::read_vector(*item.node, item.path, kCoordinate, section.log(), 3, vertex.data()) && ok;
    mesh.vertices_m.push_back(vertex);
  }
  if (!ok || items.empty()) return false;
  // The position moves to the middle of the vertices, so that the sphere around it is small wherever the file
  // put its origin.
  Vec3 lo = mesh.vertices_m.front();
  Vec3 hi = lo;
  for (const Vec3& v : mesh.vertices_m) {
    lo = lo.cwiseMin(v);
    hi = hi.cwiseMax(v);
  }
  const Vec3 middle = 0.5 * (lo + hi);
  for (Vec3& v : mesh.vertices_m) v -= middle;
  const double c = std::cos(mesh.yaw_rad);
  const double s = std::sin(mesh.yaw_rad);
  position += Vec3(c * middle.x() - s * middle.y(), s * middle.x() + c * middle.y(), middle.z());
  return true;
}

bool read_shape(Section& section, const std::string& shape, Obstacle& out) {
  bool ok = true;
  if (shape == "sphere") {
    Sphere sphere;
    ok = section.vector("center_m", Need::kRequired, kCoordinate, out.position_m);
    ok = section.number("radius_m", Need::kRequired, kSize, sphere.radius_m) && ok;
    out.shape = sphere;
  } else if (shape == "cylinder" || shape == "cone") {
    double radius_m = 0.0;
    double height_m = 0.0;
    ok = section.vector("base_m", Need::kRequired, kCoordinate, out.position_m);
    ok = section.number("radius_m", Need::kRequired, kSize, radius_m) && ok;
    ok = section.number("height_m", Need::kRequired, kSize, height_m) && ok;
    if (shape == "cylinder") {
      out.shape = Cylinder{radius_m, height_m};
    } else {
      out.shape = Cone{radius_m, height_m};
    }
  } else if (shape == "box") {
    Box box;
    ok = section.vector("center_m", Need::kRequired, kCoordinate, out.position_m);
    ok = section.vector("size_m", Need::kRequired, kSize, box.size_m) && ok;
    ok = (!section.has("yaw_deg") ||
          section.angle_deg("yaw_deg", Need::kOptional, from_to(-360, 360), box.yaw_rad)) &&
         ok;
    out.shape = box;
  } else {
    ConvexMesh mesh;
    ok = read_mesh(section, mesh, out.position_m);
    out.shape = std::move(mesh);
  }
  return ok;
}

}  // namespace

void read_frame(Section& top, Scenario& scenario) {
  auto frame = top.section("frame", Need::kOptional);
  if (!frame || !frame->is_map()) return;
  if (auto origin = frame->section("origin", Need::kRequired); origin && origin->is_map()) {
    GeoOrigin value;
    bool ok = origin->number("lat_deg", Need::kRequired, from_to(-89, 89), value.lat_deg);
    ok = origin->number("lon_deg", Need::kRequired, from_to(-180, 180), value.lon_deg) && ok;
    origin->number("elevation_m", Need::kOptional, kElevation, value.elevation_m);
    origin->finish();
    if (ok) scenario.origin = value;
  }
  frame->finish();
}

void read_bounds(Section& top, Scenario& scenario) {
  auto section = top.section("bounds_m", Need::kRequired);
  if (!section || !section->is_map()) return;
  Bounds bounds;
  bool ok = section->vector("min", Need::kRequired, kCoordinate, bounds.min_m);
  ok = section->vector("max", Need::kRequired, kCoordinate, bounds.max_m) && ok;
  section->finish();
  if (!ok) return;
  std::string axes;
  for (int axis = 0; axis < 3; ++axis) {
    if (bounds.min_m[axis] >= bounds.max_m[axis])
      axes += (axes.empty() ? "" : ", ") + std::string(1, "xyz"[axis]);
  }
  if (axes.empty()) {
    scenario.bounds = bounds;
  } else {
    top.fail(Kind::kRelation, "bounds_m", "min must be below max in " + axes);
  }
}

void read_terrain_spec(Section& top, const std::string& folder, Scenario& scenario) {
  auto section = top.section("terrain", Need::kOptional);
  if (!section || !section->is_map()) return;
  std::string kind;
  if (!section->choice("kind", Need::kRequired, {"flat", "mountains", "raster"}, kind)) return;
  if (kind == "flat") {
    FlatTerrain flat;
    section->number("elevation_m", Need::kOptional, kElevation, flat.elevation_m);
    scenario.terrain = flat;
  } else if (kind == "mountains") {
    MountainTerrain spec;
    for (const Section::Item& item : section->list("mountains", Need::kRequired, 1, kMaxMountains)) {
      Section one(*item.node, item.path, top.log());
      if (!one.is_map()) continue;
      Mountain mountain;
      one.number("x_m", Need::kRequired, kCoordinate, mountain.x_m);
      one.number("y_m", Need::kRequired, kCoordinate, mountain.y_m);
      one.number("height_m", Need::kRequired, above_to(0, 9000), mountain.height_m);
      one.number("spread_m2", Need::kOptional, above_to(0, 1e10), mountain.spread_m2);
      one.finish();
      spec.mountains.push_back(mountain);
    }
    section->number("cell_size_m", Need::kOptional, above_to(0, 1e4), spec.cell_size_m);
    scenario.terrain = std::move(spec);
  } else {
    RasterTerrain raster;
    resolve_file(*section, "file", folder, raster.file);
    section->number("no_data_elevation_m", Need::kOptional, kElevation, raster.no_data_elevation_m);
    scenario.terrain = std::move(raster);
  }
  section->finish();
}

bool read_obstacle(Section& section, double state_time_s, Obstacle& out) {
  if (!section.is_map()) return false;
  out.state_time_s = state_time_s;
  bool ok = section.integer("id", Need::kRequired, kId, out.id);
  std::string shape;
  if (!section.choice("shape", Need::kRequired, {"sphere", "cylinder", "cone", "box", "mesh"}, shape))
    return false;
  ok = read_shape(section, shape, out) && ok;
  if (section.has("velocity_mps")) {
    ok = section.vector("velocity_mps", Need::kOptional, from_to(-kMaxSpeed_mps, kMaxSpeed_mps),
                        out.velocity_mps) &&
         ok;
  }
  if (section.has("margin_m"))
    ok = section.number("margin_m", Need::kOptional, from_to(0, 1e3), out.margin_m) && ok;
  if (section.has("valid_until_s") &&
      section.number("valid_until_s", Need::kOptional, above_to(0, kMaxTime_s), out.valid_until_s)) {
    if (out.valid_until_s <= state_time_s)
      section.fail(Kind::kRelation, "valid_until_s", "must be after it appears");
  }
  section.finish();
  if (!ok) return false;
  if (const Status status = validate(out); !status.ok()) {
    section.fail(Kind::kRelation, "", status.error().message);
    return false;
  }
  return true;
}

void read_obstacles(Section& top, Scenario& scenario) {
  for (const Section::Item& item : top.list("obstacles", Need::kOptional, 0, kMaxObstacles)) {
    Section section(*item.node, item.path, top.log());
    Obstacle obstacle;
    if (!read_obstacle(section, 0.0, obstacle)) continue;
    bool is_new = true;
    for (const Obstacle& other : scenario.obstacles) is_new = is_new && other.id != obstacle.id;
    if (is_new) {
      scenario.obstacles.push_back(std::move(obstacle));
    } else {
      section.fail(Kind::kDuplicate, "id", "is the id of another obstacle");
    }
  }
}

bool resolve_file(Section& section, std::string_view key, const std::string& folder, std::string& file) {
  std::string named;
  if (!section.text(key, Need::kRequired, named)) return false;
  std::error_code error;
  const std::filesystem::path path =
      std::filesystem::path(folder) / named;  // an absolute name stays as it is
  if (!std::filesystem::is_regular_file(path, error)) {
    section.fail(Kind::kFile, key, "no such file: " + path.lexically_normal().string());
    return false;
  }
  file = path.lexically_normal().string();
  return true;
}

}  // namespace swallowtail::planner::detail
