#include "coverage/field/geojson.hpp"

#include <algorithm>
#include <limits>
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
  return {middle.y(), middle.x(), 0.0};
}

Status to_local(Ring& ring, const planner::GeoOrigin& origin) {
  for (Vec2& p : ring) {
    if (!is_finite(p)) continue;  // left for clean() to name
    const Result<Vec2> local = planner::to_local(origin, p.y(), p.x());
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

/// The areas in the frame around the origin (or as they are), those far from it left out.
std::vector<Polygon> near(const std::vector<RawField>& areas,
                          const std::optional<planner::GeoOrigin>& origin) {
  std::vector<Polygon> out;
  for (const RawField& area : areas) {
    Polygon polygon = area.polygon;
    const bool usable = !origin || to_local(polygon, *origin).ok();
    if (!usable || polygon.outline.empty()) continue;
    if (origin && polygon.outline.front().norm() > kNoFlyDistance_m) continue;
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
  if (out.origins.empty()) {
    out.no_fly.push_back(near(no_fly, out.origin));
  } else {
    for (const planner::GeoOrigin& origin : out.origins) out.no_fly.push_back(near(no_fly, origin));
  }
  return out;
}

}  // namespace swallowtail::coverage
