#include "planner/kernels/batch_field.hpp"

#include "planner/kernels/detail/batch_kernel.hpp"

namespace swallowtail::planner {
namespace {

const detail::BatchKernel& kernel() { return detail::batch_kernels().back(); }

detail::SolidList solids_of(const ObstacleField& field) {
  return {field.solids().data(), field.standing_tree().nodes(), field.supports().data()};
}

Vec3 point(const LanePoint& p, int lane) { return {p.x[lane], p.y[lane], p.z[lane]}; }

}  // namespace

detail::GroundView detail::ground_view(const Terrain& terrain) {
  const TerrainGrid& grid = *terrain.grid();
  const Terrain::Blocks blocks = terrain.blocks();
  return {.elevation_m = grid.elevation_m.data(),
          .rows = grid.rows,
          .cols = grid.cols,
          .origin_x_m = grid.origin_m.x(),
          .origin_y_m = grid.origin_m.y(),
          .per_metre = 1.0 / grid.cell_size_m,
          .block_max_m = blocks.max_m,
          .block_min_m = blocks.min_m,
          .block_rows = blocks.rows,
          .block_cols = blocks.cols,
          .block_cells = blocks.cells};
}

BatchField::BatchField(const ObstacleField& field) : field_(&field) {
  for (std::size_t i = field.standing(); i < field.size(); ++i) timed_.push_back(i);
  const Terrain& terrain = field.world().terrain();
  if (!terrain.is_flat()) ground_ = detail::ground_view(terrain);
}

void BatchField::add_length(const LanePoint& a, const LanePoint& b, Lanes& sum_m) {
  kernel().add_length(a, b, sum_m);
}

void BatchField::add_violation(const LanePoint& a, const LanePoint& b, Lanes& sum_m) const {
  kernel().add_violation(solids_of(*field_), a, b, sum_m);
}

std::span<const LaneDistance> BatchField::distances(const LanePoint& a, const LanePoint& b, double cap_m,
                                                    std::vector<LaneDistance>& buffer) const {
  if (buffer.size() < field_->standing()) buffer.resize(field_->standing());
  const std::size_t count = kernel().distances(solids_of(*field_), a, b, cap_m, buffer.data());
  return std::span<const LaneDistance>(buffer).first(count);
}

Lanes BatchField::axis_distance_m(std::size_t obstacle, const LanePoint& a, const LanePoint& b) const {
  Lanes distance_m;
  kernel().axis_distance(field_->solids()[obstacle], a, b, distance_m);
  return distance_m;
}

void BatchField::add_terrain_violation(const LanePoint& a, const LanePoint& b, Lanes& sum_m) const {
  const double required_m = field_->ground_clearance_m();
  Lanes least_m;
  const unsigned found = ground_ ? kernel().least_height(*ground_, a, b, required_m, least_m) : 0U;
  for (int lane = 0; lane < kLanes; ++lane) {
    sum_m[lane] += (found >> lane & 1U) != 0 ? required_m - least_m[lane]
                                             : field_->terrain_violation_m(point(a, lane), point(b, lane));
  }
}

void BatchField::add_length_below_ground(const LanePoint& a, const LanePoint& b, Lanes& sum_m) const {
  const Terrain& terrain = field_->world().terrain();
  Lanes length_m;
  const unsigned found = ground_ ? kernel().length_below(*ground_, a, b, length_m) : 0U;
  for (int lane = 0; lane < kLanes; ++lane) {
    sum_m[lane] +=
        (found >> lane & 1U) != 0 ? length_m[lane] : terrain.length_below(point(a, lane), point(b, lane));
  }
}

}  // namespace swallowtail::planner
