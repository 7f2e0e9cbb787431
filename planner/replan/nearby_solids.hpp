#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/kernels/obstacle_field.hpp"

namespace swallowtail::planner {

/// Which obstacles of a field may matter to a hop: a level grid over the balls of those that stand; those
/// that move are always among the answer, and so is everything where there is little. One for each search:
/// a query writes into it.
class NearbySolids {
 public:
  explicit NearbySolids(const ObstacleField& field);

  /// Every obstacle that the hop a–b may come nearer to than its distance to keep + cap_m, each once, in
  /// ascending order; and some more. Valid until the next call.
  std::span<const std::uint32_t> along(const Vec3& a, const Vec3& b, double cap_m);

 private:
  static constexpr std::size_t kFew = 40;

  void fill_cells();
  void take_cell(int col, int row);

  const ObstacleField& field_;
  std::vector<std::uint32_t> always_;
  std::vector<std::uint32_t> found_;
  std::vector<std::uint32_t> cell_begin_;  ///< of each cell in `in_cells_`, row by row; one more at the end
  std::vector<std::uint32_t> in_cells_;
  std::vector<std::uint32_t> seen_;  ///< the query in which a solid was found last
  std::uint32_t query_ = 0;
  Vec2 origin_m_ = Vec2::Zero();
  double cell_m_ = 1.0;
  int cols_ = 0;
  int rows_ = 0;
};

}  // namespace swallowtail::planner
