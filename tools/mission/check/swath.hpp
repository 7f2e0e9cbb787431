#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/mission/check/rules.hpp"

namespace swallowtail::check {

/// Counts what share of the fields the sensor swept, on a raster of cell centres.
class Swath {
 public:
  /// Cells of `cell_m`, or larger where the fields would need more than four million. No-fly areas and the
  /// fields' skipped border count for nothing.
  Swath(const Rules& rules, double cell_m);

  /// The swath, `width_m` wide, of a straight piece of flight in field `field` (index): cells of that field
  /// whose centre lies in the rectangle around a–b.
  void sweep(const P2& a, const P2& b, double width_m, std::size_t field);

  double covered_percent() const;

 private:
  bool is_asked_for(const Rules& rules, std::size_t field, const P2& centre) const;

  std::vector<std::int16_t> owner_;  ///< field index of each cell, −1 outside
  std::vector<bool> swept_;
  P2 origin_;
  double cell_m_ = 1.0;
  std::size_t rows_ = 0;
  std::size_t cols_ = 0;
};

}  // namespace swallowtail::check
