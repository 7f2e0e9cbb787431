#include "tests/support/replay_cover.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/support/cover_oracle.hpp"

namespace swallowtail::test_support {
namespace {

constexpr double kInside_m = 0.05;  ///< deeper inside a forbidden ring than this is a fault
constexpr double kStep_m = 0.5;
constexpr double kFiner = 0.1;
constexpr double kSeen_m = 0.05;            ///< besides the swath: exact cover is another test's matter
constexpr double kLineOutside_m = 0.2;      ///< of lines, in all
constexpr double kLineInHeadland_m = 0.02;  ///< besides a share of its width: arcs are polygons
constexpr double kArc = 0.002;

std::vector<Point> points_of(const coverage::Ring& ring) {
  std::vector<Point> out;
  for (const Vec2& p : ring) out.emplace_back(p.x(), p.y());
  return out;
}

Ground ground_of(const coverage::Polygon& polygon) {
  Ground out;
  out.rings.push_back(points_of(polygon.outline));
  for (const coverage::Ring& hole : polygon.holes) out.rings.push_back(points_of(hole));
  return out;
}

/// Whether the whole line keeps its height over the ground, as far as the ground lets it.
bool is_at_height(const coverage::Leg& leg, const coverage::Field& field, const coverage::Task& task,
                  const ReplayQuestion& question) {
  const Vec3 along = leg.exit_m - leg.entry_m;
  const int steps = std::max(1, static_cast<int>(std::ceil(along.norm() / kStep_m)));
  const double slack = task.height_tolerance_m + question.height_tolerance_m;
  for (int i = 0; i <= steps; ++i) {
    const Vec3 p = leg.entry_m + along * (static_cast<double>(i) / steps);
    if (std::abs(p.z() - question.ground_m(p.x(), p.y()) - field.height_m) > slack) return false;
  }
  return true;
}

bool is_seen(const Point& point, const std::vector<FlownLine>& lines, double half_m) {
  return std::any_of(lines.begin(), lines.end(), [&](const FlownLine& line) {
    const double dx = line.to.first - line.from.first;
    const double dy = line.to.second - line.from.second;
    const double length = std::hypot(dx, dy);
    if (length < 1e-9) return false;
    const double px = point.first - line.from.first;
    const double py = point.second - line.from.second;
    const double along = (px * dx + py * dy) / length;
    const double across = (px * dy - py * dx) / length;
    return std::abs(across) <= half_m + kSeen_m && along >= -kSeen_m && along <= length + kSeen_m;
  });
}

/// In the outline and in no hole, which may overlap or stick out.
bool is_on_field(const Ground& field, const Point& point) {
  for (std::size_t i = 0; i < field.rings.size(); ++i) {
    if (is_on({{field.rings[i]}}, point) != (i == 0)) return false;
  }
  return true;
}

bool is_deep_in(const Ground& ground, const Vec3& p) {
  return is_on(ground, {p.x(), p.y()}) && distance_to_border(ground, {p.x(), p.y()}) > kInside_m;
}

/// The first place of a line that a test finds, looked for at steps.
template <class Test>
std::optional<Vec3> first_of(const Vec3& from_m, const Vec3& to_m, const Test& test) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to_m - from_m).norm() / kStep_m)));
  for (int i = 0; i <= steps; ++i) {
    const Vec3 p = from_m + (to_m - from_m) * (static_cast<double>(i) / steps);
    if (test(p)) return p;
  }
  return std::nullopt;
}

std::string at_text(const Vec3& p) {
  return " at (" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ")";
}

/// Of the borders of the field and of the no-fly areas.
double distance_to_borders(const coverage::Task& task, const Ground& field, const Point& point) {
  double least = distance_to_border(field, point);
  for (const coverage::Polygon& area : task.no_fly)
    least = std::min(least, distance_to_border(ground_of(area), point));
  return least;
}

/// Width of the band that is left out along borders.
double skipped_m(const coverage::Task& task) {
  return task.rules.headland == coverage::Headland::kSkip ? task.rules.headland_m : 0.0;
}

/// Whether half a swath to one side or the other sees the field from there.
bool sees(const Ground& field, const coverage::Leg& leg, const Vec3& at_m) {
  const Vec3 along = (leg.exit_m - leg.entry_m).normalized();
  for (double aside = -leg.width_m / 2.0; aside <= leg.width_m / 2.0; aside += kFiner) {
    const Point p{at_m.x() - aside * along.y(), at_m.y() + aside * along.x()};
    if (is_on(field, p) || distance_to_border(field, p) < 2.0 * kFiner) return true;
  }
  return false;
}

/// Where a line may be: on its field, or beyond its slanted borders where that is allowed and of use.
void add_faults_of_line(const coverage::Task& task, const coverage::Leg& leg, const coverage::Field& field,
                        const ReplayQuestion& question, std::vector<std::string>& out) {
  const std::string name = "a line of field " + std::to_string(field.id);
  const auto say = [&](const std::optional<Vec3>& place, const char* what) {
    if (place) out.push_back(name + what + at_text(*place));
  };
  const double clearance_m = task.vehicle.radius_m + task.vehicle.margin_m - question.height_tolerance_m;
  say(first_of(leg.entry_m, leg.exit_m,
               [&](const Vec3& p) { return p.z() - question.ground_m(p.x(), p.y()) < clearance_m; }),
      " does not keep its clearance above ground");
  for (const coverage::Polygon& area : task.no_fly) {
    const Ground no_fly = ground_of(area);
    say(first_of(leg.entry_m, leg.exit_m, [&](const Vec3& p) { return is_deep_in(no_fly, p); }),
        " crosses a no-fly area");
  }
  for (const coverage::Ring& ring : field.polygon.holes) {
    const Ground hole{{points_of(ring)}};
    say(first_of(leg.entry_m, leg.exit_m, [&](const Vec3& p) { return is_deep_in(hole, p); }),
        " crosses a hole");
  }
  const Ground ground = ground_of(field.polygon);
  if (task.rules.beyond == coverage::Beyond::kSlantedBorders) {
    say(first_of(leg.entry_m, leg.exit_m, [&](const Vec3& p) { return !sees(ground, leg, p); }),
        " sees nothing of it");
  }
  const double band_m = (1.0 - kArc) * skipped_m(task) - kLineInHeadland_m;
  if (band_m <= 0.0 || task.rules.beyond == coverage::Beyond::kSlantedBorders) return;
  say(first_of(leg.entry_m, leg.exit_m,
               [&](const Vec3& p) {
                 return distance_to_borders(task, ground, {p.x(), p.y()}) < band_m;
               }),
      " is in its headland");
}

/// Share of the raster's points on the field and outside no-fly areas and headland that are seen from the
/// lines.
double seen_share(const coverage::Task& task, const coverage::Field& field,
                  const std::vector<FlownLine>& lines, double raster_m) {
  const Ground ground = ground_of(field.polygon);
  const double skipped = skipped_m(task);
  Vec2 lo = field.polygon.outline.front();
  Vec2 hi = lo;
  for (const Vec2& p : field.polygon.outline) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  long asked = 0;
  long seen = 0;
  for (double x = lo.x() + raster_m / 2.0; x < hi.x(); x += raster_m) {
    for (double y = lo.y() + raster_m / 2.0; y < hi.y(); y += raster_m) {
      const Point point{x, y};
      if (!is_on_field(ground, point)) continue;
      const bool forbidden = std::any_of(task.no_fly.begin(), task.no_fly.end(), [&](const auto& area) {
        const Ground no_fly = ground_of(area);
        return is_on(no_fly, point) || distance_to_border(no_fly, point) < kSeen_m;
      });
      if (forbidden) continue;
      if (skipped > 0.0 && distance_to_borders(task, ground, point) < skipped + kSeen_m) continue;
      ++asked;
      seen += is_seen(point, lines, task.sensor_width_m / 2.0) ? 1 : 0;
    }
  }
  return asked > 0 ? static_cast<double>(seen) / static_cast<double>(asked) : 1.0;
}

/// Whether one of the fields lies in the hole.
bool is_around_a_field(const coverage::Task& task, const Ground& hole) {
  return std::ranges::any_of(task.fields, [&](const coverage::Field& field) {
    return std::ranges::all_of(field.polygon.outline, [&](const Vec2& p) {
      return is_on(hole, {p.x(), p.y()}) || distance_to_border(hole, {p.x(), p.y()}) < kInside_m;
    });
  });
}

}  // namespace

std::vector<std::string> faults_of_cover(const coverage::Task& task, const coverage::Plan& plan,
                                         const ReplayQuestion& question, double& worst_share) {
  std::vector<std::string> out;
  if (question.raster_m <= 0.0) return out;
  for (const coverage::FieldReport& report : plan.fields) {
    if (report.status == coverage::FieldStatus::kRefused) continue;
    const std::string name = "field " + std::to_string(report.id);
    const auto field = std::find_if(task.fields.begin(), task.fields.end(),
                                    [&](const coverage::Field& f) { return f.id == report.id; });
    if (field == task.fields.end()) {
      out.push_back(name + " is not in the task");
      continue;
    }
    std::vector<FlownLine> lines;
    int at_wrong_height = 0;
    for (const coverage::Leg& leg : plan.legs) {
      if (leg.field_id != report.id) continue;
      add_faults_of_line(task, leg, *field, question, out);
      if (!is_at_height(leg, *field, task, question) && ++at_wrong_height > report.beyond_tolerance) {
        out.push_back("a leg of " + name + " leaves its height by more than the tolerance");
        continue;
      }
      lines.push_back({{leg.entry_m.x(), leg.entry_m.y()}, {leg.exit_m.x(), leg.exit_m.y()}});
    }
    const CoverVerdict verdict = judge_cover(ground_of(field->polygon), lines,
                                             {.width_m = task.sensor_width_m,
                                              .cell_m = task.sensor_width_m,
                                              .step_m = kStep_m,
                                              .tolerance_m = 0.02});
    if (verdict.outside_m > kLineOutside_m && task.rules.beyond == coverage::Beyond::kNever)
      out.push_back("a line leaves " + name);
    // What is said to be covered in part must at the least be covered as said, and name the place.
    const bool is_whole = report.status == coverage::FieldStatus::kPlanned;
    const double said = report.area_m2 > 0.0 ? report.covered_m2 / report.area_m2 : 1.0;
    const double least = is_whole ? question.covered_share : said - (1.0 - question.covered_share);
    if (!is_whole && report.reason.find("gap") == std::string::npos)
      out.push_back(name + " is covered in part and no gap is named");
    double share = seen_share(task, *field, lines, question.raster_m);
    // A coarse raster of a small field knows no thousandths.
    if (share < least) share = seen_share(task, *field, lines, question.raster_m * kFiner);
    worst_share = std::min(worst_share, share);
    if (share < least) out.push_back(name + " is covered to " + std::to_string(100.0 * share) + " % only");
  }
  return out;
}

std::vector<std::string> faults_of_way(const coverage::Task& task, const std::vector<Vec3>& way) {
  std::vector<Ground> forbidden;
  std::vector<Ground> around_fields;
  for (const coverage::Field& field : task.fields) {
    for (const coverage::Ring& ring : field.polygon.holes) {
      const Ground hole{{points_of(ring)}};
      (is_around_a_field(task, hole) ? around_fields : forbidden).push_back(hole);
    }
  }
  const auto begins_or_ends_in = [&](const Ground& hole) {
    return is_deep_in(hole, way.front()) || is_deep_in(hole, way.back());
  };
  // Who flies to a field in a hole crosses what lies around it, and may cross other such holes.
  if (std::ranges::none_of(around_fields, begins_or_ends_in))
    forbidden.insert(forbidden.end(), around_fields.begin(), around_fields.end());
  std::vector<Ground> fields;
  for (const coverage::Field& field : task.fields) fields.push_back(ground_of(field.polygon));
  const auto is_over_a_field = [&](const Vec3& p) {
    return std::ranges::any_of(fields, [&](const Ground& field) {
      return is_on_field(field, {p.x(), p.y()}) || distance_to_border(field, {p.x(), p.y()}) <= kInside_m;
    });
  };
  const auto look = [&](const Ground& barred, const auto& excuse) -> std::vector<std::string> {
    if (begins_or_ends_in(barred)) return {};
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      const auto place =
          first_of(way[i], way[i + 1], [&](const Vec3& p) { return is_deep_in(barred, p) && !excuse(p); });
      if (place) return {"a flight crosses a hole or no-fly area" + at_text(*place)};
    }
    return {};
  };
  for (const Ground& hole : forbidden) {
    if (auto faults = look(hole, is_over_a_field); !faults.empty()) return faults;
  }
  for (const coverage::Polygon& area : task.no_fly) {
    if (auto faults = look(ground_of(area), [](const Vec3&) { return false; }); !faults.empty())
      return faults;
  }
  return {};
}

std::vector<std::string> faults_of_way_inside(const coverage::Task& task, const std::vector<Vec3>& way) {
  // No-fly areas may cut a field in two, and lines may end beyond it.
  if (!task.no_fly.empty() || task.rules.beyond != coverage::Beyond::kNever) return {};
  std::vector<std::string> out;
  for (const coverage::Field& field : task.fields) {
    const Ground ground = ground_of(field.polygon);
    const auto is_off = [&](const Vec3& p) {
      return !is_on_field(ground, {p.x(), p.y()}) && distance_to_border(ground, {p.x(), p.y()}) > kInside_m;
    };
    if (is_off(way.front()) || is_off(way.back())) continue;
    std::optional<Vec3> place;
    for (std::size_t i = 0; i + 1 < way.size() && !place; ++i) place = first_of(way[i], way[i + 1], is_off);
    if (!place) return {};
    out.push_back("a flight leaves field " + std::to_string(field.id) + at_text(*place));
  }
  return out;
}

}  // namespace swallowtail::test_support
