#pragma once

#include <string>
#include <vector>

#include "tools/bench/core/convergence.hpp"
#include "tools/drawing/svg.hpp"

namespace swallowtail::bench {

enum class Scale { kLinear, kLog };

struct Series {
  std::string name;
  report::Points points;  ///< (x, y); what is not finite, or not positive on a log scale, is left out
  report::Points lower;   ///< both empty: no band
  report::Points upper;
  bool dots = false;  ///< marks instead of a line
};

struct Chart {
  std::string title;
  std::string x_label;
  std::string y_label;
  Scale x_scale = Scale::kLinear;
  Scale y_scale = Scale::kLinear;
  std::vector<Series> series;
};

/// The chart as SVG with axes and a legend; colours go by the place in `series` and come round again.
std::string draw(const Chart& chart);
const char* color_of(std::size_t series);

/// Median and quartiles of values above `best_known`, in percent, as a line with its band.
Series gap_series(const std::string& name, const Band& band, double best_known);

}  // namespace swallowtail::bench
