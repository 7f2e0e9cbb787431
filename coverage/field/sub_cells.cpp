#include "coverage/field/sub_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "coverage/field/detail/geos.hpp"
#include "coverage/field/strips.hpp"
#include "coverage/field/swath.hpp"
#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

using planner::Terrain;

constexpr double kLeastSample_m = 0.25;
constexpr double kApart_m = 0.02;  ///< of samples, besides where the ground turns
constexpr int kMaxSamples = 20'000;
/// A sub-cell is not cut shorter than this share of the sensor's width.
constexpr double kLeastLength = 0.25;

/// The ground below a piece, so far along it as this share of its length.
struct GroundAt {
  double share = 0.0;
  double height_m = 0.0;
};

/// Where a piece crosses the raster's lines of one direction, as shares of its length.
void add_crossings(double from, double to, double origin, double cell_m, std::vector<double>& shares) {
  if (from == to) return;
  const double first = std::ceil((std::min(from, to) - origin) / cell_m);
  for (double k = first; origin + k * cell_m < std::max(from, to); k += 1.0)
    shares.push_back(std::clamp((origin + k * cell_m - from) / (to - from), 0.0, 1.0));
}

/// Ground elevations along a piece, both ends included: over a raster at even steps, where its lines are
/// crossed and at the lowest and highest places in between, so that all of the ground is within their range.
std::vector<GroundAt> ground_profile(const Piece& piece, const Terrain& terrain) {
  const auto height = [&](double share) {
    const Vec2 p = piece.from_m + (piece.to_m - piece.from_m) * share;
    return terrain.height_at(p.x(), p.y());
  };
  if (terrain.grid() == nullptr) return {{0.0, height(0.0)}, {1.0, height(1.0)}};
  const planner::TerrainGrid& grid = *terrain.grid();
  const double length = (piece.to_m - piece.from_m).norm();
  const double wanted_m = std::max(kLeastSample_m, grid.cell_size_m / 2.0);
  const int steps = std::clamp(static_cast<int>(std::ceil(length / wanted_m)), 1, kMaxSamples);
  std::vector<double> shares;
  for (int i = 0; i <= steps; ++i) shares.push_back(static_cast<double>(i) / steps);
  if (length < grid.cell_size_m * kMaxSamples) {
    add_crossings(piece.from_m.x(), piece.to_m.x(), grid.origin_m.x(), grid.cell_size_m, shares);
    add_crossings(piece.from_m.y(), piece.to_m.y(), grid.origin_m.y(), grid.cell_size_m, shares);
  }
  std::ranges::sort(shares);
  // Places that are as good as one would make sub-cells of no length.
  const double apart = kApart_m / std::max(length, kApart_m);
  const auto repeated = std::ranges::unique(shares, [&](double a, double b) { return b - a < apart; });
  shares.erase(repeated.begin(), repeated.end());
  while (shares.size() > 1 && shares.back() > 1.0 - apart) shares.pop_back();
  shares.push_back(1.0);
  std::vector<GroundAt> out{{shares.front(), height(shares.front())}};
  for (std::size_t i = 1; i < shares.size(); ++i) {
    const GroundAt before = out.back();
    const GroundAt next{shares[i], height(shares[i])};
    // Between lines of the raster the ground is a parabola: its turn, if there is one.
    const double middle = height((before.share + next.share) / 2.0);
    const double bend = before.height_m - 2.0 * middle + next.height_m;
    const double turn = 0.5 + (before.height_m - next.height_m) / (4.0 * bend);
    if (turn > 0.0 && turn < 1.0) {
      const double share = before.share + turn * (next.share - before.share);
      out.push_back({share, height(share)});
    }
    out.push_back(next);
  }
  return out;
}

/// A stretch of a piece as fractions of it, and the ground's range below.
struct Stretch {
  double from = 0.0;
  double to = 1.0;
  double ground_min = 0.0;
  double ground_max = 0.0;
};

/// The longest stretches, one after another, over which the ground stays within twice the tolerance.
std::vector<Stretch> level_stretches(const std::vector<GroundAt>& ground, double length_m,
                                     const CutParams& params) {
  const double least = kLeastLength * params.sensor_width_m / std::max(length_m, 1e-9);
  std::vector<Stretch> out;
  Stretch now{0.0, 0.0, ground[0].height_m, ground[0].height_m};
  for (std::size_t i = 1; i < ground.size(); ++i) {
    const double low = std::min(now.ground_min, ground[i].height_m);
    const double high = std::max(now.ground_max, ground[i].height_m);
    const bool long_enough = now.to - now.from >= least;
    if (high - low > 2.0 * params.height_tolerance_m && long_enough) {
      out.push_back(now);
      now = {now.to, now.to, ground[i - 1].height_m, ground[i - 1].height_m};
    }
    now.to = ground[i].share;
    now.ground_min = std::min(now.ground_min, ground[i].height_m);
    now.ground_max = std::max(now.ground_max, ground[i].height_m);
  }
  out.push_back(now);
  return out;
}

/// Cuts a piece by height, then by what one battery flies, and adds its sub-cells.
void add_sub_cells(const Field& field, const Piece& piece, const Terrain& terrain, const CutParams& params,
                   FieldCut& out) {
  const double length = (piece.to_m - piece.from_m).norm();
  for (const Stretch& stretch : level_stretches(ground_profile(piece, terrain), length, params)) {
    const Vec2 from = piece.from_m + (piece.to_m - piece.from_m) * stretch.from;
    const Vec2 to = piece.from_m + (piece.to_m - piece.from_m) * stretch.to;
    const double top = -terrain.min_height_above(Vec3(from.x(), from.y(), 0.0), Vec3(to.x(), to.y(), 0.0));
    const double ground_max = std::max(stretch.ground_max, top);
    if (ground_max - stretch.ground_min > 2.02 * params.height_tolerance_m + 1e-6) ++out.beyond_tolerance;
    const double z =
        std::max((stretch.ground_min + ground_max) / 2.0 + field.height_m, ground_max + params.clearance_m);
    const int count =
        std::max(1, static_cast<int>(std::ceil((to - from).norm() / params.max_length_m - 1e-9)));
    for (int i = 0; i < count && out.sub_cells.size() <= kMaxSubCells; ++i) {
      const Vec2 a = from + (to - from) * (static_cast<double>(i) / count);
      const Vec2 b = from + (to - from) * (static_cast<double>(i + 1) / count);
      out.sub_cells.push_back({static_cast<std::uint32_t>(out.sub_cells.size()), field.id,
                               Vec3(a.x(), a.y(), z), Vec3(b.x(), b.y(), z), field.height_m,
                               params.sensor_width_m});
    }
  }
}

/// `solid`: the no-fly areas, clean.
StripParams strip_params(const CutParams& params, const Field& field, const std::vector<Polygon>& solid) {
  StripParams out;
  out.sensor_width_m = params.sensor_width_m;
  out.overlap = params.rules.overlap;
  out.sweep_rad = params.sweep_rad;
  out.piece_cost_m = params.piece_cost_m;
  out.turn = params.turn;
  out.headland_m = params.rules.headland == Headland::kFly ? params.rules.headland_m : 0.0;
  out.beyond = params.rules.beyond;
  if (out.beyond == Beyond::kNever) return out;
  out.closed = solid;
  for (const Ring& hole : field.polygon.holes) out.closed.push_back({hole, {}});
  return out;
}

std::string metres(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g m", value);
  return text.data();
}

Status check_height(const Field& field, const Terrain& terrain, const CutParams& params) {
  const double tolerance = terrain.is_flat() ? 0.0 : params.height_tolerance_m;
  if (field.height_m - tolerance < params.clearance_m) {
    return bad_input("Its height of " + metres(field.height_m) + " above ground, less a tolerance of " +
                     metres(tolerance) + ", is below the vehicle's clearance of " +
                     metres(params.clearance_m) + ".");
  }
  if (field.height_m + tolerance > params.rules.ceiling_m) {
    return bad_input("Its height of " + metres(field.height_m) + " above ground, with a tolerance of " +
                     metres(tolerance) + ", is above the legal ceiling of " + metres(params.rules.ceiling_m) +
                     ".");
  }
  return {};
}

/// Greatest distance between two corners, or `enough` as soon as one is found that is greater.
double extent_m(const std::vector<Polygon>& polygons, double enough) {
  double extent = 0.0;
  for (const Polygon& polygon : polygons) {
    const Box box = bounds_of(polygon.outline);
    if ((box.hi - box.lo).maxCoeff() >= enough) return enough;
    for (const Vec2& a : polygon.outline) {
      for (const Vec2& b : polygon.outline) extent = std::max(extent, (a - b).norm());
      if (extent >= enough) return enough;
    }
  }
  return extent;
}

/// Refuses what a sensor or a battery of this size makes no sense for.
Status check_size(const std::vector<Polygon>& polygons, const CutParams& params) {
  const double extent = extent_m(polygons, params.sensor_width_m);
  if (extent < params.sensor_width_m) {
    return bad_input("The sensor is wider (" + metres(params.sensor_width_m) +
                     ") than the field is across (" + metres(extent) + "): there is no strip to fly.");
  }
  if (params.max_length_m < params.sensor_width_m) {
    return bad_input("One battery flies no more than " + metres(params.max_length_m) +
                     " at the field's height besides climb and landing: it cannot cross the field.");
  }
  return {};
}

Result<std::vector<Polygon>> cleaned_areas(const std::vector<Polygon>& no_fly) {
  std::vector<Polygon> solid;
  for (std::size_t i = 0; i < no_fly.size(); ++i) {
    const Result<std::vector<Polygon>> area = clean(no_fly[i]);
    if (!area) return bad_input("No-fly area " + std::to_string(i) + ": " + area.error().message);
    solid.insert(solid.end(), area->begin(), area->end());
  }
  return solid;
}

Result<std::vector<Polygon>> without(const std::vector<Polygon>& polygons,
                                     const std::vector<Polygon>& solid) {
  if (solid.empty()) return polygons;
  constexpr auto kOnGrid = detail::Shape::Vertices::kOnGrid;  // areas are drawn along borders
  const detail::Shape left = detail::Shape::of(polygons).minus(detail::Shape::of(solid, kOnGrid), kOnGrid);
  if (!left.ok()) return internal_error("GEOS could not take the no-fly areas off.");
  std::vector<Polygon> out;
  for (const Polygon& part : left.parts()) {
    const Result<std::vector<Polygon>> tidy = clean(part);
    if (tidy) out.insert(out.end(), tidy->begin(), tidy->end());
  }
  if (out.empty()) return infeasible("It lies wholly within no-fly areas.");
  return out;
}

Result<std::vector<Polygon>> without_headland(const std::vector<Polygon>& polygons, const FieldRules& rules) {
  if (rules.headland != Headland::kSkip || rules.headland_m <= 0.0) return polygons;
  std::vector<Polygon> out;
  const detail::Shape left =
      detail::Shape::of(polygons).inset(rules.headland_m, detail::Shape::Corners::kRound);
  for (const Polygon& part : left.parts()) {
    const Result<std::vector<Polygon>> tidy = clean(part);
    if (tidy) out.insert(out.end(), tidy->begin(), tidy->end());
  }
  if (out.empty())
    return infeasible("Nothing is left of it within a headland of " + metres(rules.headland_m) + ".");
  return out;
}

std::string partly_reason(const FieldCut& cut, const std::optional<Gap>& gap) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "Only %.2f %% of it can be seen from lines inside it",
                100.0 * cut.covered_m2 / cut.area_m2);
  std::string out = text.data();
  if (gap) {
    std::snprintf(text.data(), text.size(), "; the largest gap, %.3g m², is at ", gap->area_m2);
    out += text.data() + place_text(gap->place_m);
  }
  return out + ".";
}

Status cut(const Field& field, const Terrain& terrain, const CutParams& params, FieldCut& out) {
  const Result<std::vector<Polygon>> cleaned = clean(field.polygon);
  if (!cleaned) return cleaned.error();
  Result<std::vector<Polygon>> solid = cleaned_areas(params.no_fly);
  if (!solid) return solid.error();
  Result<std::vector<Polygon>> allowed = without(*cleaned, *solid);
  if (!allowed) return allowed.error();
  out.polygons = std::move(*allowed);
  const Result<std::vector<Polygon>> asked = without_headland(out.polygons, params.rules);
  if (!asked) return asked.error();
  for (const Polygon& polygon : *asked) out.area_m2 += area_m2(polygon);
  if (const Status status = check_height(field, terrain, params); !status) return status;
  if (const Status status = check_size(*asked, params); !status) return status;
  for (const Polygon& polygon : *asked) {
    const Result<Strips> strips = cut_strips(polygon, strip_params(params, field, *solid));
    if (!strips) return strips.error();
    if (out.cells == 0) out.sweep_rad = strips->sweep_rad;
    out.strips += strips->count;
    out.cells += static_cast<int>(strips->pieces.size());
    for (const Piece& piece : strips->pieces) add_sub_cells(field, piece, terrain, params, out);
  }
  if (out.sub_cells.size() > kMaxSubCells) {
    return bad_input("It needs more than " + std::to_string(kMaxSubCells) +
                     " sub-cells; a wider sensor or a greater height tolerance is needed.");
  }
  const Result<SwathArea> area = swath_area(*asked, out.sub_cells);
  if (!area) return area.error();
  out.covered_m2 = area->covered_m2;
  out.outside_m2 = area->outside_m2;
  out.status = FieldStatus::kPlanned;
  if (out.covered_m2 >= kCoveredShare * out.area_m2) return {};
  out.status = FieldStatus::kPartly;
  out.reason = partly_reason(out, largest_gap(*asked, out.sub_cells));
  return {};
}

/// "Field 'nl-3' near (1.0, 2.0) m: ", by its first corner that is a place.
std::string name_and_place(const Field& field) {
  std::string out = "Field '" + field.name + "'";
  const auto corner = std::find_if(field.polygon.outline.begin(), field.polygon.outline.end(),
                                   [](const Vec2& p) { return is_finite(p); });
  if (corner != field.polygon.outline.end()) out += " near " + place_text(*corner);
  return out + ": ";
}

}  // namespace

Status validate(const FieldRules& rules) {
  if (!is_within(rules.overlap, 0.0, 0.9))
    return bad_input("The overlap must be a share from 0 to 0.9 of the sensor's width.");
  if (!is_non_negative(rules.headland_m)) return bad_input("The headland must not be negative.");
  if (!(rules.ceiling_m > 0.0)) return bad_input("The legal ceiling must be positive.");
  return {};
}

Status validate(const CutParams& params) {
  if (const Status status = validate(params.rules); !status) return status;
  if (!is_positive(params.sensor_width_m))
    return bad_input("The sensor width must be a positive number of metres.");
  if (!is_non_negative(params.height_tolerance_m))
    return bad_input("The height tolerance must not be negative.");
  if (!is_non_negative(params.clearance_m)) return bad_input("The clearance must not be negative.");
  if (!(params.max_length_m > 0.0))
    return bad_input("One battery does not lift the vehicle to the field's height and back.");
  return {};
}

FieldCut cut_field(const Field& field, const Terrain& terrain, const CutParams& params) {
  FieldCut out;
  out.id = field.id;
  out.name = field.name;
  Status status = is_positive(field.height_m)
                      ? validate(params)
                      : bad_input("Its height above ground must be a positive number of metres.");
  if (status.ok()) status = cut(field, terrain, params, out);
  if (!status.ok()) {
    out.status = FieldStatus::kRefused;
    out.reason = status.error().message;
    out.sub_cells.clear();
  }
  if (!out.reason.empty()) out.reason = name_and_place(field) + out.reason;
  return out;
}

}  // namespace swallowtail::coverage
