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

void move_centre_to(std::vector<Field>& fields, const Vec2& place_m) {
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
  for (auto& field : fields) {
    move(field.polygon.outline);
    for (auto& hole : field.polygon.holes) move(hole);
  }
}

}  // namespace

Result<ScenarioFields> fields_of(const planner::Scenario& scenario) {
  if (!scenario.coverage)
    return bad_input(scenario.file + ": there is no coverage section, so there are no fields.");
  const auto& spec = *scenario.coverage;
  // Fields that are moved elsewhere are read around their own middle: their place on Earth no longer matters.
  FieldFileOptions options{.origin = spec.place_at_m ? std::nullopt : scenario.origin,
                           .default_height_m = spec.heights.default_m,
                           .class_heights_m = spec.heights.classes};
  auto file = read_fields(spec.fields_file, options);
  if (!file) return file.error();
  auto fields = chosen(std::move(file->fields), spec.field_ids);
  if (!fields) return fields.error();
  if (spec.place_at_m) move_centre_to(*fields, *spec.place_at_m);
  return ScenarioFields{std::move(*fields), scenario.origin ? scenario.origin : file->origin};
}

}  // namespace swallowtail::coverage
