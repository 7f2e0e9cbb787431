#include "tests/support/replay_cover.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/cover_oracle.hpp"

namespace swallowtail::test_support {
namespace {

constexpr double kInside_m = 0.05;  ///< deeper inside a forbidden ring than this is a fault
constexpr double kStep_m = 0.5;
constexpr double kFiner = 0.1;
constexpr double kSeen_m = 0.05;        ///< besides the swath: exact cover is another test's matter
constexpr double kLineOutside_m = 0.2;  ///< of lines, in all

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

/// Share of the raster's points on the field and outside no-fly areas that are seen from the lines.
double seen_share(const coverage::Task& task, const coverage::Field& field,
                  const std::vector<FlownLine>& lines, double raster_m) {
  const Ground ground = ground_of(field.polygon);
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
      if (!is_on(ground, point)) continue;
      const bool forbidden = std::any_of(task.no_fly.begin(), task.no_fly.end(), [&](const auto& area) {
        const Ground no_fly = ground_of(area);
        return is_on(no_fly, point) || distance_to_border(no_fly, point) < kSeen_m;
      });
      if (forbidden) continue;
      ++asked;
      seen += is_seen(point, lines, task.sensor_width_m / 2.0) ? 1 : 0;
    }
  }
  return asked > 0 ? static_cast<double>(seen) / static_cast<double>(asked) : 1.0;
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
    if (verdict.outside_m > kLineOutside_m) out.push_back("a line leaves " + name);
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
  for (const coverage::Field& field : task.fields) {
    for (const coverage::Ring& hole : field.polygon.holes) forbidden.push_back({{points_of(hole)}});
  }
  for (const coverage::Polygon& area : task.no_fly) forbidden.push_back(ground_of(area));
  const auto is_deep = [](const Ground& ring, const Vec3& p) {
    return is_on(ring, {p.x(), p.y()}) && distance_to_border(ring, {p.x(), p.y()}) > kInside_m;
  };
  for (const Ground& ring : forbidden) {
    if (is_deep(ring, way.front()) || is_deep(ring, way.back())) continue;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      const Vec3 piece = way[i + 1] - way[i];
      const int steps = std::max(1, static_cast<int>(std::ceil(piece.norm() / kStep_m)));
      for (int s = 0; s <= steps; ++s) {
        const Vec3 p = way[i] + piece * (static_cast<double>(s) / steps);
        if (!is_deep(ring, p)) continue;
        return {"a flight crosses a hole or no-fly area at (" + std::to_string(p.x()) + ", " +
                std::to_string(p.y()) + ")"};
      }
    }
  }
  return {};
}

}  // namespace swallowtail::test_support
