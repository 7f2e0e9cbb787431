#include "coverage/field/geojson.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "coverage/field/detail/vector_file.hpp"
#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

using detail::RawField;
using detail::RawFile;

constexpr double kMaxDistance_m =
    2e5;  ///< of a vertex from the origin: beyond, the local frame is no longer true to scale
constexpr double kNoFlyDistance_m = 2e4;

planner::GeoOrigin middle_of(std::span<const RawField> fields) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box box{Vec2(kFar, kFar), Vec2(-kFar, -kFar)};
  for (const RawField& field : fields) {
    for (const Vec2& p : field.polygon.outline) {
      if (!is_finite(p)) continue;
      box.lo = box.lo.cwiseMin(p);
      box.hi = box.hi.cwiseMax(p);
    }
  }
  if (box.lo.x() > box.hi.x()) return {};
  const Vec2 middle = (box.lo + box.hi) / 2.0;
  return {middle.y(), std::remainder(middle.x(), 360.0), 0.0};
}

Box box_of(const Ring& outline) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box out{Vec2(kFar, kFar), Vec2(-kFar, -kFar)};
  for (const Vec2& p : outline) {
    if (is_finite(p)) out = {out.lo.cwiseMin(p), out.hi.cwiseMax(p)};
  }
  return out;
}

/// Longitudes that run on over the 180th meridian, near a given one. A polygon broken there is made whole if
/// it is then small; one round the Earth stays.
void run_on(Polygon& polygon, double lon_deg) {
  constexpr double kTurn_deg = 360.0;
  constexpr double kSmall_deg = 10.0;
  const auto shift = [&polygon](const auto& change) {
    for (Vec2& p : polygon.outline) p.x() += change(p.x());
    for (Ring& hole : polygon.holes) {
      for (Vec2& p : hole) p.x() += change(p.x());
    }
  };
  Box box = box_of(polygon.outline);
  if (!(box.lo.x() <= box.hi.x())) return;
  if (box.hi.x() - box.lo.x() > kTurn_deg / 2.0 &&
      std::ranges::all_of(polygon.outline,
                          [&](const Vec2& p) {
                            return p.x() - box.lo.x() < kSmall_deg || box.hi.x() - p.x() < kSmall_deg;
                          }) &&
      box.hi.x() - box.lo.x() < kTurn_deg)
    shift([&](double x) { return x - box.lo.x() < kSmall_deg ? kTurn_deg : 0.0; });
  box = box_of(polygon.outline);
  const double turns = std::round((lon_deg - (box.lo.x() + box.hi.x()) / 2.0) / kTurn_deg);
  if (turns != 0.0) shift([&](double) { return turns * kTurn_deg; });
}

double first_longitude(std::span<const RawField> fields) {
  for (const RawField& field : fields) {
    for (const Vec2& p : field.polygon.outline) {
      if (is_finite(p)) return std::remainder(p.x(), 360.0);
    }
  }
  return 0.0;
}

Status to_local(Ring& ring, const planner::GeoOrigin& origin) {
  for (Vec2& p : ring) {
    if (!is_finite(p)) continue;  // left for clean() to name
    const Result<Vec2> local = planner::to_local(origin, p.y(), std::remainder(p.x(), 360.0));
    if (!local) return local.error();
    if (local->norm() > kMaxDistance_m)
      return bad_input("A vertex lies more than 200 km from the origin of the local frame.");
    p = *local;
  }
  return {};
}

Status to_local(Polygon& polygon, const planner::GeoOrigin& origin) {
  Status status = to_local(polygon.outline, origin);
  for (Ring& hole : polygon.holes) {
    if (status.ok()) status = to_local(hole, origin);
  }
  return status;
}

/// Whether an outline in degrees comes within a distance of a place, roughly and rather too near.
bool is_near(const Ring& outline, const planner::GeoOrigin& place) {
  constexpr double kDegree_m = 110'000.0;
  const Box box = box_of(outline);
  const double up = kNoFlyDistance_m / kDegree_m;
  const double cosine = std::cos(place.lat_deg * std::numbers::pi / 180.0);
  const Vec2 reach(up / std::max(0.01, cosine), up);
  const Vec2 at(place.lon_deg, place.lat_deg);
  return ((box.lo - reach - at).array() <= 0.0).all() && ((box.hi + reach - at).array() >= 0.0).all();
}

/// The areas in the frame around the origin (or as they are), those far from it left out.
Result<std::vector<Polygon>> near(const std::vector<RawField>& areas,
                                  const std::optional<planner::GeoOrigin>& origin) {
  std::vector<Polygon> out;
  for (const RawField& area : areas) {
    Polygon polygon = area.polygon;
    if (origin) run_on(polygon, origin->lon_deg);
    if (polygon.outline.empty() || (origin && !is_near(polygon.outline, *origin))) continue;
    const Status status = origin ? to_local(polygon, *origin) : Status();
    if (!status)
      return Error{status.error().code, "No-fly area '" + area.name + "': " + status.error().message};
    out.push_back(std::move(polygon));
  }
  return out;
}

Result<double> height_of(const RawField& field, const FieldFileOptions& options) {
  double height = options.default_height_m;
  const auto known = options.class_heights_m.find(field.height_class);
  if (known != options.class_heights_m.end()) height = known->second;
  if (field.height_m) height = *field.height_m;
  if (!is_positive(height))
    return bad_input("Field '" + field.name + "' has a height_m of " + std::to_string(height) +
                     "; it must be positive.");
  return height;
}

}  // namespace

Result<FieldFile> read_fields(const std::string& path, const FieldFileOptions& options) {
  Result<RawFile> raw = detail::read_vector_file(path);
  if (!raw) return raw.error();
  std::vector<RawField> no_fly;
  if (!options.no_fly_file.empty()) {
    Result<RawFile> more = detail::read_vector_file(options.no_fly_file);
    if (!more) return more.error();
    if (more->is_local != raw->is_local) {
      return bad_input("'" + options.no_fly_file + "' and '" + path +
                       "': one is in local metres, the other on Earth.");
    }
    no_fly = std::move(more->fields);
  }
  for (RawField& field : raw->fields) {
    if (field.no_fly) no_fly.push_back(std::move(field));
  }
  std::erase_if(raw->fields, [](const RawField& field) { return field.no_fly; });
  if (raw->fields.empty()) return bad_input("'" + path + "' holds no polygon to cover.");
  const double lon_deg = options.origin ? options.origin->lon_deg : first_longitude(raw->fields);
  if (!raw->is_local) {
    for (RawField& field : raw->fields) run_on(field.polygon, lon_deg);
  }
  FieldFile out;
  const bool shares = options.frame == FieldFrame::kShared;
  if (!raw->is_local && shares) out.origin = options.origin ? *options.origin : middle_of(raw->fields);
  for (RawField& field : raw->fields) {
    const Result<double> height = height_of(field, options);
    if (!height) return height.error();
    if (!raw->is_local) {
      if (!shares) out.origins.push_back(middle_of({&field, 1}));
      const Status status = to_local(field.polygon, shares ? *out.origin : out.origins.back());
      if (!status)
        return Error{status.error().code,
                     "'" + path + "', field '" + field.name + "': " + status.error().message};
    }
    out.fields.push_back(
        {static_cast<std::uint32_t>(out.fields.size() + 1), field.name, std::move(field.polygon), *height});
  }
  std::vector<std::optional<planner::GeoOrigin>> frames(out.origins.begin(), out.origins.end());
  if (frames.empty()) frames.push_back(out.origin);
  for (const auto& frame : frames) {
    Result<std::vector<Polygon>> areas = near(no_fly, frame);
    if (!areas) return areas.error();
    out.no_fly.push_back(std::move(*areas));
  }
  return out;
}

}  // namespace swallowtail::coverage
