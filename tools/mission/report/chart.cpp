#include "tools/mission/report/chart.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::report {
namespace {

constexpr double kWidth = 900.0;
constexpr double kHeight = 260.0;
constexpr double kLeft = 56.0;
constexpr double kRight = 16.0;
constexpr double kTop = 34.0;
constexpr double kBottom = 34.0;

struct Axes {
  double t_max = 1.0;
  double v_min = 0.0;
  double v_max = 1.0;
  double x(double t) const { return kLeft + (kWidth - kLeft - kRight) * t / t_max; }
  double y(double v) const {
    return kHeight - kBottom - (kHeight - kTop - kBottom) * (v - v_min) / (v_max - v_min);
  }
};

/// 1, 2 or 5 times a power of ten, about `span` / `count`.
double tick_step(double span, int count) {
  const double raw = span / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10.0 * power;
}

Axes fit(const std::vector<Series>& series, const std::vector<Level>& levels) {
  Axes axes;
  double top = 0.0;
  for (const auto& one : series) {
    for (const auto& [t, v] : one.points) {
      axes.t_max = std::max(axes.t_max, t);
      top = std::max(top, v);
      axes.v_min = std::min(axes.v_min, v);
    }
  }
  for (const auto& level : levels) top = std::max(top, level.value);
  axes.v_max = top > axes.v_min ? top + 0.05 * (top - axes.v_min) : axes.v_min + 1.0;
  return axes;
}

void draw_axes(Svg& svg, const Axes& axes, const std::string& unit) {
  const double v_step = tick_step(axes.v_max - axes.v_min, 5);
  for (double v = std::ceil(axes.v_min / v_step) * v_step; v <= axes.v_max; v += v_step) {
    svg.line(kLeft, axes.y(v), kWidth - kRight, axes.y(v), "stroke=\"#d9e0e6\"");
    svg.text(kLeft - 6, axes.y(v) + 4, number(v), "text-anchor=\"end\"");
  }
  const double t_step = tick_step(axes.t_max, 9);
  for (double t = 0.0; t <= axes.t_max; t += t_step) {
    svg.line(axes.x(t), kHeight - kBottom, axes.x(t), kHeight - kBottom + 4, "stroke=\"#5b6b7a\"");
    svg.text(axes.x(t), kHeight - kBottom + 18, number(t, 0), "text-anchor=\"middle\"");
  }
  svg.line(kLeft, kHeight - kBottom, kWidth - kRight, kHeight - kBottom, "stroke=\"#5b6b7a\"");
  svg.text(kWidth - kRight, kHeight - 4, "mission time, s", "text-anchor=\"end\" fill=\"#5b6b7a\"");
  svg.text(8, kTop - 10, unit, "fill=\"#5b6b7a\"");
}

}  // namespace

std::string draw_chart(const std::string& title, const std::string& unit, const std::vector<Series>& series,
                       const std::vector<Level>& levels) {
  Svg svg(kWidth, kHeight, title);
  const Axes axes = fit(series, levels);
  svg.rect(0, 0, kWidth, kHeight, "fill=\"#ffffff\"");
  draw_axes(svg, axes, unit);
  for (const auto& level : levels) {
    svg.line(kLeft, axes.y(level.value), kWidth - kRight, axes.y(level.value),
             "stroke=\"" + level.color + "\" stroke-dasharray=\"5 4\"");
    svg.text(kWidth - kRight - 4, axes.y(level.value) - 4, level.name,
             "text-anchor=\"end\" fill=\"" + level.color + "\"");
  }
  double legend_x = kLeft + 60;
  for (const auto& one : series) {
    Points pixels;
    for (const auto& [t, v] : one.points) pixels.emplace_back(axes.x(t), axes.y(v));
    if (one.dots) {
      for (const auto& [x, y] : pixels)
        svg.circle(x, y, 3, "fill=\"" + one.color + "\" fill-opacity=\"0.75\"");
    } else {
      svg.polyline(pixels, "stroke=\"" + one.color + "\" stroke-width=\"1.6\"");
    }
    svg.rect(legend_x, kTop - 20, 10, 10, "fill=\"" + one.color + "\"");
    svg.text(legend_x + 15, kTop - 11, one.name);
    legend_x += 40.0 + 7.0 * static_cast<double>(one.name.size());
  }
  return svg.finish();
}

}  // namespace swallowtail::report
