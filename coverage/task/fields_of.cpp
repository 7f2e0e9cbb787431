#include "coverage/task/fields_of.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "coverage/field/geojson.hpp"

namespace swallowtail::coverage {
namespace {

Result<std::vector<Field>> chosen(std::vector<Field> fields, const std::vector<std::string>& ids) {
  if (ids.empty()) return fields;
  std::vector<Field> picked;
  for (const auto& id : ids) {
    bool found = false;
    for (const auto& field : fields) {
      if (field.name != id && std::to_string(field.id) != id) continue;
      picked.push_back(field);
      found = true;
    }
    if (!found) return not_found("coverage.field_ids: the fields' file has no feature \"" + id + "\".");
  }
  return picked;
}

void move_centre_to(std::vector<Field>& fields, std::vector<Polygon>& no_fly, const Vec2& place_m) {
  Vec2 lo = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 hi = -lo;
  for (const auto& field : fields) {
    for (const auto& vertex : field.polygon.outline) {
      lo = lo.cwiseMin(vertex);
      hi = hi.cwiseMax(vertex);
    }
  }
  const Vec2 shift = place_m - (lo + hi) / 2.0;
  const auto move = [&shift](Ring& ring) {
    for (auto& vertex : ring) vertex += shift;
  };
  const auto move_polygon = [&move](Polygon& polygon) {
    move(polygon.outline);
    for (auto& hole : polygon.holes) move(hole);
  };
  for (auto& field : fields) move_polygon(field.polygon);
  for (auto& area : no_fly) move_polygon(area);
}

}  // namespace

Result<ScenarioFields> fields_of(const planner::Scenario& scenario) {
  if (!scenario.coverage)
    return bad_input(scenario.file + ": there is no coverage section, so there are no fields.");
  const auto& spec = *scenario.coverage;
  // Fields that are moved elsewhere are read around their own middle: their place on Earth no longer matters.
  FieldFileOptions options{.origin = spec.place_at_m ? std::nullopt : scenario.origin,
                           .default_height_m = spec.heights.default_m,
                           .class_heights_m = spec.heights.classes,
                           .no_fly_file = spec.no_fly_file};
  auto file = read_fields(spec.fields_file, options);
  if (!file) return file.error();
  auto fields = chosen(std::move(file->fields), spec.field_ids);
  if (!fields) return fields.error();
  std::vector<Polygon> no_fly = std::move(file->no_fly.front());
  if (spec.place_at_m) move_centre_to(*fields, no_fly, *spec.place_at_m);
  return ScenarioFields{std::move(*fields), scenario.origin ? scenario.origin : file->origin,
                        std::move(no_fly)};
}

FieldRules rules_of(const planner::CoverageSpec& spec) {
  FieldRules out;
  out.overlap = spec.overlap;
  if (spec.headland == planner::HeadlandUse::kSkip) out.headland = Headland::kSkip;
  if (spec.headland == planner::HeadlandUse::kFly) out.headland = Headland::kFly;
  out.headland_m = spec.headland_m;
  if (spec.lines_beyond_borders) out.beyond = Beyond::kSlantedBorders;
  if (spec.ceiling_m) out.ceiling_m = *spec.ceiling_m;
  return out;
}

}  // namespace swallowtail::coverage
