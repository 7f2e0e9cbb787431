#pragma once

#include <string>
#include <vector>

#include "tools/drawing/svg.hpp"

namespace swallowtail::report {

struct Series {
  std::string name;
  std::string color;
  Points points;      ///< (mission seconds, value)
  bool dots = false;  ///< marks instead of a line
};

struct Level {
  std::string name;
  double value = 0.0;
  std::string color;
};

/// Values over mission time, with axes, a legend and horizontal marks. The value axis begins at 0 unless a
/// value is below it.
std::string draw_chart(const std::string& title, const std::string& unit, const std::vector<Series>& series,
                       const std::vector<Level>& levels = {});

}  // namespace swallowtail::report
