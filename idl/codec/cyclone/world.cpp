#include "idl/codec/cyclone/world.hpp"

namespace swallowtail::codec::cyclone {

namespace {

data::Refusal get_elevation(float wire, float& value) {
  value = wire;
  return {};
}

void put_elevation(float value, float& wire) { wire = value; }

data::Refusal get_vertex(const swallowtail_Vector3& w, data::Vec3& d) {
  d = vec3(w);
  return {};
}

void put_vertex(const data::Vec3& d, swallowtail_Vector3& w) { w = vec3(d); }

}  // namespace

data::Refusal to_data(const swallowtail_TerrainTile& w, data::TerrainTile& d) {
  d.map_id = w.map_id;
  d.row = w.row;
  d.col = w.col;
  d.revision = w.revision;
  d.origin = geo_origin(w.origin);
  d.origin_x_m = w.origin_x_m;
  d.origin_y_m = w.origin_y_m;
  d.cell_size_m = w.cell_size_m;
  d.map_rows = w.map_rows;
  d.map_cols = w.map_cols;
  d.first_row = w.first_row;
  d.first_col = w.first_col;
  d.tile_rows = w.tile_rows;
  d.tile_cols = w.tile_cols;
  if (const auto refusal = get_sequence(w.elevation_m, data::kMaxTileCells, d.elevation_m, get_elevation))
    return refusal;
  return {};
}

void to_wire(const data::TerrainTile& d, swallowtail_TerrainTile& w) {
  w.map_id = d.map_id;
  w.row = d.row;
  w.col = d.col;
  w.revision = d.revision;
  w.origin = geo_origin(d.origin);
  w.origin_x_m = d.origin_x_m;
  w.origin_y_m = d.origin_y_m;
  w.cell_size_m = d.cell_size_m;
  w.map_rows = d.map_rows;
  w.map_cols = d.map_cols;
  w.first_row = d.first_row;
  w.first_col = d.first_col;
  w.tile_rows = d.tile_rows;
  w.tile_cols = d.tile_cols;
  put_sequence(d.elevation_m, w.elevation_m, put_elevation);
}

data::Refusal to_data(const swallowtail_Obstacle& w, data::Obstacle& d) {
  d.obstacle_id = w.obstacle_id;
  d.revision = w.revision;
  if (!get_enum(w.shape, data::ObstacleShape::kMesh, d.shape)) return kBadEnumerator;
  d.position = vec3(w.position);
  d.velocity_mps = vec3(w.velocity_mps);
  d.state_time_s = w.state_time_s;
  d.valid_until_s = w.valid_until_s;
  d.radius_m = w.radius_m;
  d.height_m = w.height_m;
  d.size_m = vec3(w.size_m);
  d.yaw_rad = w.yaw_rad;
  d.margin_m = w.margin_m;
  if (const auto refusal = get_sequence(w.vertices, data::kMaxMeshVertices, d.vertices, get_vertex))
    return refusal;
  return {};
}

void to_wire(const data::Obstacle& d, swallowtail_Obstacle& w) {
  w.obstacle_id = d.obstacle_id;
  w.revision = d.revision;
  put_enum(d.shape, w.shape);
  w.position = vec3(d.position);
  w.velocity_mps = vec3(d.velocity_mps);
  w.state_time_s = d.state_time_s;
  w.valid_until_s = d.valid_until_s;
  w.radius_m = d.radius_m;
  w.height_m = d.height_m;
  w.size_m = vec3(d.size_m);
  w.yaw_rad = d.yaw_rad;
  w.margin_m = d.margin_m;
  put_sequence(d.vertices, w.vertices, put_vertex);
}

}  // namespace swallowtail::codec::cyclone
