#include "tools/bench/plot/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tools/bench/core/table.hpp"

namespace swallowtail::bench {
namespace {

using report::Points;
using report::Svg;

constexpr double kWidth = 900.0;
constexpr double kPlotHeight = 340.0;
constexpr double kLeft = 70.0;
constexpr double kRight = 20.0;
constexpr double kTop = 40.0;
constexpr double kBottom = 46.0;
constexpr double kLegendLine = 18.0;
constexpr double kLegendColumn = 210.0;
constexpr int kLegendColumns = 4;
/// What a logarithmic axis still shows of a gap that is none.
constexpr double kLeastPercent = 1e-4;

struct Axis {
  Scale scale = Scale::kLinear;
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double from_px = 0.0;
  double to_px = 0.0;

  bool shows(double v) const { return std::isfinite(v) && (scale == Scale::kLinear || v > 0.0); }
  double along(double v) const { return scale == Scale::kLog ? std::log10(v) : v; }
  void include(double v) {
    if (!shows(v)) return;
    low = std::min(low, along(v));
    high = std::max(high, along(v));
  }
  /// Leaves no axis empty; a logarithmic one begins and ends at powers of ten.
  void finish() {
    if (low > high) low = high = 0.0;
    if (scale == Scale::kLog) {
      low = std::floor(low);
      high = std::ceil(high);
    }
    if (low == high) high = low + 1.0;
  }
  double px(double v) const { return from_px + (to_px - from_px) * (along(v) - low) / (high - low); }
  std::vector<double> ticks() const {
    std::vector<double> values;
    const double raw = (high - low) / 6.0;
    double step = std::max(1.0, std::ceil(raw));
    if (scale == Scale::kLinear) {
      const double power = std::pow(10.0, std::floor(std::log10(raw)));
      step = raw <= power         ? power
             : raw <= 2.0 * power ? 2.0 * power
             : raw <= 5.0 * power ? 5.0 * power
                                  : 10.0 * power;
    }
    for (double v = std::ceil(low / step) * step; v <= high + 1e-9 * step; v += step)
      values.push_back(scale == Scale::kLog ? std::pow(10.0, v) : v);
    return values;
  }
};

Points pixels_of(const Points& points, const Axis& x, const Axis& y) {
  Points pixels;
  for (const auto& [px, py] : points) {
    if (x.shows(px) && y.shows(py)) pixels.emplace_back(x.px(px), y.px(py));
  }
  return pixels;
}

void draw_axes(Svg& svg, const Chart& chart, const Axis& x, const Axis& y) {
  for (const double v : x.ticks()) {
    svg.line(x.px(v), y.from_px, x.px(v), y.to_px, "stroke=\"#e6ebef\"");
    svg.text(x.px(v), y.from_px + 16, significant(v, 3), "text-anchor=\"middle\"");
  }
  for (const double v : y.ticks()) {
    svg.line(x.from_px, y.px(v), x.to_px, y.px(v), "stroke=\"#e6ebef\"");
    svg.text(x.from_px - 6, y.px(v) + 4, significant(v, 3), "text-anchor=\"end\"");
  }
  svg.line(x.from_px, y.from_px, x.to_px, y.from_px, "stroke=\"#5b6b7a\"");
  svg.line(x.from_px, y.from_px, x.from_px, y.to_px, "stroke=\"#5b6b7a\"");
  svg.text(x.to_px, y.from_px + 34, chart.x_label, "text-anchor=\"end\" fill=\"#5b6b7a\"");
  svg.text(8, kTop - 8, chart.y_label, "fill=\"#5b6b7a\"");
  svg.text(0.5 * kWidth, 18, chart.title, "text-anchor=\"middle\" font-weight=\"bold\"");
}

void draw_series(Svg& svg, const Series& series, const std::string& color, const Axis& x, const Axis& y) {
  Points ring = pixels_of(series.lower, x, y);
  const Points upper = pixels_of(series.upper, x, y);
  if (ring.size() > 1 && upper.size() > 1) {
    ring.insert(ring.end(), upper.rbegin(), upper.rend());
    svg.rings({ring}, "fill=\"" + color + "\" fill-opacity=\"0.10\"");
  }
  const Points line = pixels_of(series.points, x, y);
  if (series.dots) {
    for (const auto& [px, py] : line)
      svg.circle(px, py, 3, "fill=\"" + color + "\" fill-opacity=\"0.7\"", series.name);
  } else {
    svg.polyline(line, "stroke=\"" + color + "\" stroke-width=\"1.6\"");
  }
}

}  // namespace

const char* color_of(std::size_t series) {
  constexpr std::array kColors{"#0b5fa5", "#d1495b", "#2e8b57", "#b8860b", "#7b4fa3", "#00838f",
                               "#8d5524", "#c2185b", "#455a64", "#6a8d00", "#3f51b5", "#e07b00"};
  return kColors[series % kColors.size()];
}

std::string draw(const Chart& chart) {
  const auto legend_lines = static_cast<double>((chart.series.size() + kLegendColumns - 1) / kLegendColumns);
  Svg svg(kWidth, kPlotHeight + kLegendLine * legend_lines, chart.title);
  Axis x{chart.x_scale};
  Axis y{chart.y_scale};
  for (const Series& series : chart.series) {
    for (const Points* points : {&series.points, &series.lower, &series.upper}) {
      for (const auto& [px, py] : *points) {
        if (!x.shows(px) || !y.shows(py)) continue;
        x.include(px);
        y.include(py);
      }
    }
  }
  x.finish();
  y.finish();
  x.from_px = kLeft;
  x.to_px = kWidth - kRight;
  y.from_px = kPlotHeight - kBottom;
  y.to_px = kTop;
  svg.rect(0, 0, kWidth, svg.height_px(), "fill=\"#ffffff\"");
  draw_axes(svg, chart, x, y);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    draw_series(svg, chart.series[i], color_of(i), x, y);
    const double left = kLeft + kLegendColumn * static_cast<double>(i % kLegendColumns);
    const double top = kPlotHeight + kLegendLine * static_cast<double>(i / kLegendColumns) - 8;
    svg.rect(left, top, 10, 10, std::string("fill=\"") + color_of(i) + "\"");
    svg.text(left + 15, top + 10, chart.series[i].name);
  }
  return svg.finish();
}

Series gap_series(const std::string& name, const Band& band, double best_known) {
  const auto percent = [best_known](double v) {
    return std::max(kLeastPercent, 100.0 * (v / best_known - 1.0));
  };
  Series series{name, {}, {}, {}, false};
  for (std::size_t i = 0; i < band.effort.size(); ++i) {
    series.points.emplace_back(band.effort[i], percent(band.median[i]));
    series.lower.emplace_back(band.effort[i], percent(band.lower[i]));
    series.upper.emplace_back(band.effort[i], percent(band.upper[i]));
  }
  return series;
}

}  // namespace swallowtail::bench
