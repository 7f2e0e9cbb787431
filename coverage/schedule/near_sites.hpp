#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "coverage/field/sub_cells.hpp"

namespace swallowtail::coverage {

/// Finds the sites of other sub-cells near a site, by a grid over all of them. Site 2i is α of sub-cell i,
/// 2i + 1 its β.
class NearSites {
 public:
  struct Near {
    double distance_m = 0.0;  ///< in space
    std::size_t site = 0;
    auto operator<=>(const Near&) const = default;
  };

  explicit NearSites(std::span<const SubCell> cells);

  /// Up to `count`, the nearest first; of equally near ones the lower number first.
  std::vector<Near> of(std::size_t site, std::size_t count) const;

 private:
  std::size_t column_of(double x_m) const;
  std::size_t row_of(double y_m) const;

  std::vector<Vec3> sites_m_;
  Vec2 corner_m_ = Vec2::Zero();
  double side_m_ = 1.0;
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<std::size_t> first_;   ///< by square, row by row, and one past the last
  std::vector<std::size_t> listed_;  ///< sites, square by square
};

}  // namespace swallowtail::coverage
