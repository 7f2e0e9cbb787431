#include "tools/mission/report/map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "tools/drawing/svg.hpp"

namespace swallowtail::report {
namespace {

constexpr double kWidth = 900.0;
constexpr double kPad = 24.0;
constexpr double kLegend = 30.0;

/// Local metres to pixels.
struct View {
  double west = std::numeric_limits<double>::infinity();
  double south = std::numeric_limits<double>::infinity();
  double east = -std::numeric_limits<double>::infinity();
  double north = -std::numeric_limits<double>::infinity();

  void include(double x, double y) {
    west = std::min(west, x);
    east = std::max(east, x);
    south = std::min(south, y);
    north = std::max(north, y);
  }
  double scale() const { return (kWidth - 2 * kPad) / std::max(east - west, 1.0); }
  double height_px() const { return 2 * kPad + kLegend + (north - south) * scale(); }
  double x(double east_m) const { return kPad + (east_m - west) * scale(); }
  double y(double north_m) const { return kPad + (north - north_m) * scale(); }
  std::pair<double, double> at(double east_m, double north_m) const { return {x(east_m), y(north_m)}; }
};

View view_of(const check::Rules& rules, const check::FlightLog& log) {
  View view;
  for (const auto& field : rules.fields) {
    for (const auto& ring : field.rings) {
      for (const auto& p : ring) view.include(p.x, p.y);
    }
  }
  for (const auto& s : log.states) view.include(s.position.x_m, s.position.y_m);
  for (const auto& c : log.chargers) view.include(c.position.x_m, c.position.y_m);
  for (const auto& plan : log.plans) {
    for (const auto& w : plan.waypoints) view.include(w.position.x_m, w.position.y_m);
  }
  if (!(view.east >= view.west)) view = {0.0, 0.0, 100.0, 100.0};
  const double border = 0.04 * std::max({view.east - view.west, view.north - view.south, 20.0});
  view.west -= border;
  view.east += border;
  view.south -= border;
  view.north += border;
  if (view.north - view.south < 0.35 * (view.east - view.west)) {
    const double more = 0.35 * (view.east - view.west) - (view.north - view.south);
    view.south -= more / 2;
    view.north += more / 2;
  }
  return view;
}

std::string ground_color(double share) {
  const auto mix = [share](int low, int high) {
    return std::to_string(static_cast<int>(low + share * (high - low)));
  };
  return "rgb(" + mix(232, 172) + "," + mix(238, 160) + "," + mix(224, 130) + ")";
}

/// Runs of equal colour of a coarse raster, row by row.
void draw_ground(Svg& svg, const View& view, const check::Ground& ground) {
  svg.rect(0, 0, kWidth, view.height_px(), "fill=\"#eef2ea\"");
  if (ground.rows < 2) return;
  constexpr int kCols = 150;
  constexpr int kShades = 14;
  const double cell = (view.east - view.west) / kCols;
  const int rows = static_cast<int>(std::ceil((view.north - view.south) / cell));
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  std::vector<double> z(static_cast<std::size_t>(rows) * kCols);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < kCols; ++c) {
      const double elevation = ground.at(view.west + (c + 0.5) * cell, view.south + (r + 0.5) * cell);
      z[static_cast<std::size_t>(r * kCols + c)] = elevation;
      low = std::min(low, elevation);
      high = std::max(high, elevation);
    }
  }
  const auto shade = [&](int r, int c) {
    return static_cast<int>((z[static_cast<std::size_t>(r * kCols + c)] - low) / std::max(high - low, 1e-9) *
                                (kShades - 1) +
                            0.5);
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < kCols;) {
      int end = c + 1;
      while (end < kCols && shade(r, end) == shade(r, c)) ++end;
      const double px = cell * view.scale();
      svg.rect(view.x(view.west + c * cell), view.y(view.south + (r + 1) * cell), (end - c) * px + 0.5,
               px + 0.5, "fill=\"" + ground_color(static_cast<double>(shade(r, c)) / (kShades - 1)) + "\"");
      c = end;
    }
  }
  svg.text(kPad, 16, "ground " + number(low, 0) + " to " + number(high, 0) + " m");
}

std::vector<Points> rings_at(const View& view, const check::Rings& area) {
  std::vector<Points> rings;
  for (const auto& ring : area) {
    Points points;
    for (const auto& p : ring) points.push_back(view.at(p.x, p.y));
    rings.push_back(std::move(points));
  }
  return rings;
}

void draw_fields(Svg& svg, const View& view, const check::Rules& rules) {
  for (const auto& field : rules.fields) {
    const std::vector<Points> rings = rings_at(view, field.rings);
    const std::string fill = field.height_m > 15.0 ? "#9cc48a" : "#c8dd9a";
    svg.rings(rings, "fill=\"" + fill + "\" fill-opacity=\"0.65\" stroke=\"#5d7d3f\"",
              "field " + field.id + ", flown " + number(field.height_m) + " m above ground");
  }
  for (const auto& road : rules.roads)
    svg.polyline(rings_at(view, {road}).front(), "stroke=\"#8a8172\" stroke-width=\"2\"");
  for (const auto& area : rules.no_drive)
    svg.rings(rings_at(view, area), "fill=\"#8a8172\" fill-opacity=\"0.5\" stroke=\"#5c5548\"",
              "closed to the ground robot");
  for (const auto& area : rules.no_fly)
    svg.rings(rings_at(view, area), "fill=\"#c0392b\" fill-opacity=\"0.25\" stroke=\"#c0392b\"",
              "no-fly area");
}

std::vector<Points> footprint(const View& view, const check::Solid& solid, const check::P3& at) {
  Points points;
  const double c = std::cos(solid.yaw_rad);
  const double s = std::sin(solid.yaw_rad);
  const auto corner = [&](double x, double y) {
    points.push_back(view.at(at.x + c * x - s * y, at.y + s * x + c * y));
  };
  for (const auto& [sx, sy] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    corner(sx * solid.size_m.x, sy * solid.size_m.y);
  return {points};
}

void draw_solid_at(Svg& svg, const View& view, const check::Solid& solid, double time_s,
                   const std::string& style) {
  const double age = time_s - solid.since_s;
  const check::P3 at{solid.at.x + solid.velocity_mps.x * age, solid.at.y + solid.velocity_mps.y * age,
                     solid.at.z};
  const std::string tooltip =
      "obstacle " + std::to_string(solid.id) + " from " + number(solid.appears_s, 0) + " s";
  if (solid.shape == data::ObstacleShape::kBox) {
    svg.rings(footprint(view, solid, at), style, tooltip);
  } else if (solid.shape == data::ObstacleShape::kMesh) {
    for (const auto& v : solid.vertices)
      svg.circle(view.x(at.x + v.x), view.y(at.y + v.y), 2, style, tooltip);
  } else {
    svg.circle(view.x(at.x), view.y(at.y), solid.radius_m * view.scale(), style, tooltip);
  }
}

void draw_solids(Svg& svg, const View& view, const check::Rules& rules, double end_s) {
  for (const auto& solid : rules.solids) {
    const double until = std::min(solid.vanishes_s, end_s);
    if (solid.appears_s > end_s) continue;
    const std::string style = "fill=\"#c0392b\" fill-opacity=\"0.55\" stroke=\"#7d2118\"";
    draw_solid_at(svg, view, solid, solid.appears_s, style);
    const bool moves = solid.velocity_mps.x != 0.0 || solid.velocity_mps.y != 0.0;
    if (!moves) continue;
    const double age = until - solid.since_s;
    const double from_age = solid.appears_s - solid.since_s;
    svg.line(view.x(solid.at.x + solid.velocity_mps.x * from_age),
             view.y(solid.at.y + solid.velocity_mps.y * from_age),
             view.x(solid.at.x + solid.velocity_mps.x * age), view.y(solid.at.y + solid.velocity_mps.y * age),
             "stroke=\"#7d2118\" stroke-dasharray=\"3 3\"");
    draw_solid_at(svg, view, solid, until, "fill=\"none\" stroke=\"#7d2118\" stroke-dasharray=\"3 3\"");
  }
}

void draw_strips(Svg& svg, const View& view, const check::FlightLog& log) {
  if (log.coverage_plans.empty()) return;
  for (const auto& leg : log.coverage_plans.front().legs) {
    if (leg.kind != data::LegKind::kCover) continue;
    svg.line(view.x(leg.entry.x_m), view.y(leg.entry.y_m), view.x(leg.exit.x_m), view.y(leg.exit.y_m),
             "stroke=\"#4d6b8a\" stroke-opacity=\"0.45\" stroke-dasharray=\"6 4\"");
  }
}

std::string mode_color(data::VehicleMode mode) {
  switch (mode) {
    case data::VehicleMode::kCovering:
      return "#1f5fbf";
    case data::VehicleMode::kTransfer:
      return "#e08a1e";
    default:
      return "#8e44ad";
  }
}

void draw_flight(Svg& svg, const View& view, const check::FlightLog& log) {
  Points run;
  std::string color;
  const auto end_run = [&] {
    svg.polyline(run, "stroke=\"" + color + "\" stroke-width=\"1.6\"");
    run.clear();
  };
  for (const auto& s : log.states) {
    const bool grounded = s.mode == data::VehicleMode::kDocked || s.mode == data::VehicleMode::kLanded;
    const auto at = view.at(s.position.x_m, s.position.y_m);
    if (grounded) {
      end_run();
      continue;
    }
    if (mode_color(s.mode) != color) {
      if (!run.empty()) run.push_back(at);
      end_run();
      color = mode_color(s.mode);
    }
    if (run.empty() || std::hypot(run.back().first - at.first, run.back().second - at.second) > 0.7)
      run.push_back(at);
  }
  end_run();
}

void draw_charger(Svg& svg, const View& view, const check::FlightLog& log) {
  Points way;
  std::set<std::uint32_t> charged;
  for (const auto& c : log.chargers) {
    const auto at = view.at(c.position.x_m, c.position.y_m);
    if (way.empty() || std::hypot(way.back().first - at.first, way.back().second - at.second) > 1.0)
      way.push_back(at);
    if (c.activity == data::ChargerActivity::kCharging && charged.insert(c.rendezvous_id).second) {
      svg.circle(at.first, at.second, 7, "fill=\"#f1c40f\" stroke=\"#7a6205\"",
                 "charged here from " + number(c.time_s, 0) + " s");
    }
  }
  svg.polyline(way, "stroke=\"#6b4f1d\" stroke-width=\"1.2\" stroke-dasharray=\"2 3\"");
}

void draw_legend(Svg& svg, const View& view) {
  const std::pair<const char*, const char*> entries[] = {
      {"#1f5fbf", "covering"},     {"#e08a1e", "transfer"}, {"#8e44ad", "take-off, landing, hold"},
      {"#6b4f1d", "ground robot"}, {"#f1c40f", "recharge"}, {"#c0392b", "obstacle"}};
  double x = kPad;
  const double y = view.height_px() - 12;
  for (const auto& [color, words] : entries) {
    svg.rect(x, y - 9, 10, 10, "fill=\"" + std::string(color) + "\"");
    svg.text(x + 15, y, words);
    x += 40.0 + 6.6 * static_cast<double>(std::string(words).size());
  }
  const double bar_m = std::pow(10.0, std::floor(std::log10((view.east - view.west) / 4)));
  const double bar_y = 12;
  svg.line(kWidth - kPad - bar_m * view.scale(), bar_y, kWidth - kPad, bar_y,
           "stroke=\"#1b2733\" stroke-width=\"3\"");
  svg.text(kWidth - kPad - bar_m * view.scale() - 6, bar_y + 4, number(bar_m, 0) + " m",
           "text-anchor=\"end\"");
}

}  // namespace

std::string draw_map(const check::Rules& rules, const check::FlightLog& log, const std::string& title) {
  const View view = view_of(rules, log);
  Svg svg(kWidth, view.height_px(), title);
  draw_ground(svg, view, rules.ground);
  draw_fields(svg, view, rules);
  draw_strips(svg, view, log);
  draw_charger(svg, view, log);
  draw_flight(svg, view, log);
  draw_solids(svg, view, rules, log.states.empty() ? 0.0 : log.states.back().time_s);
  if (!log.states.empty())
    svg.circle(view.x(log.states.front().position.x_m), view.y(log.states.front().position.y_m), 5,
               "fill=\"#ffffff\" stroke=\"#1b2733\" stroke-width=\"2\"", "start");
  draw_legend(svg, view);
  return svg.finish();
}

}  // namespace swallowtail::report
