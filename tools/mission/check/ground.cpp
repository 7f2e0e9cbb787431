#include <algorithm>
#include <cmath>

#include "tools/mission/check/rules.hpp"

namespace swallowtail::check {

double Ground::at(double x, double y) const {
  if (rows < 2 || cols < 2) return z_m.empty() ? 0.0 : static_cast<double>(z_m.front());
  const double u = std::clamp((x - west_m) / cell_m, 0.0, static_cast<double>(cols - 1));
  const double v = std::clamp((y - south_m) / cell_m, 0.0, static_cast<double>(rows - 1));
  const std::size_t c = std::min(static_cast<std::size_t>(u), cols - 2);
  const std::size_t r = std::min(static_cast<std::size_t>(v), rows - 2);
  const double fu = u - static_cast<double>(c);
  const double fv = v - static_cast<double>(r);
  const auto z = [this](std::size_t row, std::size_t col) {
    return static_cast<double>(z_m[row * cols + col]);
  };
  return (1 - fv) * ((1 - fu) * z(r, c) + fu * z(r, c + 1)) +
         fv * ((1 - fu) * z(r + 1, c) + fu * z(r + 1, c + 1));
}

}  // namespace swallowtail::check
