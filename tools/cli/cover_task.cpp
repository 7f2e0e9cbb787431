#include "tools/cli/cover_task.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <numbers>
#include <utility>

#include "coverage/field/geojson.hpp"
#include "coverage/field/places.hpp"
#include "coverage/task/energy_of.hpp"
#include "coverage/task/fields_of.hpp"
#include "coverage/task/ground_of.hpp"
#include "planner/base/checks.hpp"
#include "planner/scenario/load.hpp"

namespace swallowtail::cli {
namespace {

Vec3 on_ground(const planner::Terrain& terrain, const Vec2& site) {
  return {site.x(), site.y(), terrain.height_at(site.x(), site.y())};
}

/// The first corner of a field that is a place outside no-fly areas and holes; south-west of all of them
/// where there is none.
Vec2 start_of(const std::vector<coverage::Field>& fields, const std::vector<coverage::Polygon>& no_fly) {
  Vec2 least = Vec2::Zero();
  const auto look = [&](const coverage::Ring& ring) {
    for (const Vec2& corner : ring) {
      if (is_finite(corner)) least = least.cwiseMin(corner - Vec2::Ones());
    }
  };
  for (const coverage::Field& field : fields) {
    for (const Vec2& corner : field.polygon.outline) {
      if (is_finite(corner) && !coverage::barred_at(fields, no_fly, corner)) return corner;
    }
    look(field.polygon.outline);
    for (const coverage::Ring& hole : field.polygon.holes) look(hole);
  }
  for (const coverage::Polygon& area : no_fly) look(area.outline);
  return least;
}

void start_at(coverage::Task& task, const Vec3& site) {
  task.start_m = site;
  task.charger.start_m = site;
}

double extent_m(const std::vector<coverage::Field>& fields) {
  Vec2 lo = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 hi = -lo;
  for (const auto& field : fields) {
    for (const Vec2& corner : field.polygon.outline) {
      lo = lo.cwiseMin(corner);
      hi = hi.cwiseMax(corner);
    }
  }
  return fields.empty() ? 0.0 : (hi - lo).maxCoeff();
}

bool is_chosen(const FieldsJob& job, const coverage::Field& field) {
  return job.field_ids.empty() || std::ranges::find(job.field_ids, field.name) != job.field_ids.end() ||
         std::ranges::find(job.field_ids, std::to_string(field.id)) != job.field_ids.end();
}

Result<coverage::FieldFile> read(const FieldsJob& job, coverage::FieldFrame frame) {
  coverage::FieldFileOptions options;
  options.frame = frame;
  options.default_height_m = job.default_height_m;
  options.class_heights_m = job.class_heights_m;
  options.no_fly_file = job.no_fly_file;
  auto file = coverage::read_fields(job.file, options);
  if (!file) return file.error();
  coverage::FieldFile chosen;
  chosen.origin = file->origin;
  for (std::size_t i = 0; i < file->fields.size(); ++i) {
    if (!is_chosen(job, file->fields[i])) continue;
    chosen.fields.push_back(std::move(file->fields[i]));
    if (i >= file->origins.size()) continue;
    chosen.origins.push_back(file->origins[i]);
    chosen.no_fly.push_back(std::move(file->no_fly[i]));
  }
  if (file->origins.empty()) chosen.no_fly = std::move(file->no_fly);
  if (chosen.fields.empty()) return not_found(job.file + ": has none of the fields asked for.");
  return chosen;
}

/// The robot may go as far beyond the fields.
constexpr double kGroundMargin_m = 200.0;

Status set_ways(const FieldsJob& job, const planner::Terrain& terrain, coverage::Task& task) {
  Vec2 lo = task.start_m.head<2>();
  Vec2 hi = lo;
  for (const auto& field : task.fields) {
    for (const Vec2& corner : field.polygon.outline) {
      lo = lo.cwiseMin(corner);
      hi = hi.cwiseMax(corner);
    }
  }
  const Vec2 margin = Vec2::Constant(kGroundMargin_m);
  planner::ChargerSpec spec = job.ways;
  spec.speed_mps = task.charger.speed_mps;
  auto travel = coverage::ground_of(spec, {lo - margin, hi + margin}, task.origin, terrain);
  if (!travel) return travel.error();
  task.charger.travel = std::move(*travel);
  return {};
}

}  // namespace

Result<CoverJob> job_of(const planner::Scenario& scenario, std::uint64_t seed) {
  auto terrain = planner::load_terrain(scenario);
  if (!terrain) return terrain.error();
  auto fields = coverage::fields_of(scenario);
  if (!fields) return fields.error();
  const planner::CoverageSpec& spec = *scenario.coverage;

  coverage::Task task;
  task.vehicle_id = scenario.vehicle.id;
  task.vehicle = scenario.vehicle.limits;
  task.origin = fields->origin;
  task.fields = std::move(fields->fields);
  task.no_fly = std::move(fields->no_fly);
  task.sensor_width_m = spec.sensor_width_m;
  task.rules = coverage::rules_of(spec);
  task.sweep_rad = spec.sweep_rad;
  task.height_tolerance_m = spec.height_tolerance_m;
  task.height_band_m = spec.height_band_m;
  task.neighbours = spec.neighbours;
  task.battery.capacity = spec.battery.capacity;
  task.battery.reserve = spec.battery.reserve;
  task.battery.levels = spec.battery.levels;
  task.battery.charge_s_per_unit = spec.battery.charge_s_per_unit;
  task.battery.model = coverage::energy_model_of(scenario);
  task.charger.id = spec.charger.id;
  task.charger.speed_mps = spec.charger.speed_mps;
  task.charger.take_off_s = spec.charger.take_off_s;
  task.charger.landing_s = spec.charger.landing_s;
  task.charger.start_m = on_ground(*terrain, spec.charger.start_m);
  if (const auto& own = spec.charger.battery)
    task.charger.battery = {own->capacity, own->drive_per_s, own->per_charged, own->refill_s, own->reserve};
  const coverage::Box ground{scenario.bounds.min_m.head<2>(), scenario.bounds.max_m.head<2>()};
  auto travel = coverage::ground_of(spec.charger, ground, task.origin, *terrain);
  if (!travel) return travel.error();
  task.charger.travel = std::move(*travel);
  task.battery.taper_from = spec.battery.taper_from;
  task.battery.taper_end_rate = spec.battery.taper_end_rate;
  task.start_m = planner::start_position_m(scenario, *terrain);
  task.seed = seed;
  CoverJob job;
  job.name = scenario.name;
  job.terrain = std::move(*terrain);
  job.tasks.push_back(std::move(task));
  return job;
}

Result<CoverJob> job_of(const FieldsJob& fields) {
  CoverJob job;
  job.name = std::filesystem::path(fields.file).filename().string();
  coverage::Task task = fields.task;
  if (fields.sweep_deg) task.sweep_rad = *fields.sweep_deg * std::numbers::pi / 180.0;

  if (fields.split != FieldsJob::Split::kEach) {
    auto file = read(fields, coverage::FieldFrame::kShared);
    const bool is_one = file.ok() && (fields.split == FieldsJob::Split::kOne ||
                                      extent_m(file->fields) <= kMaxMissionExtent_m);
    if (is_one) {
      task.fields = std::move(file->fields);
      task.origin = file->origin;
      task.no_fly = std::move(file->no_fly.front());
      start_at(task, on_ground(job.terrain, start_of(task.fields, task.no_fly)));
      if (const Status status = set_ways(fields, job.terrain, task); !status) return status.error();
      job.tasks.push_back(std::move(task));
      return job;
    }
    if (!file && fields.split == FieldsJob::Split::kOne) return file.error();
  }
  auto file = read(fields, coverage::FieldFrame::kPerField);
  if (!file) return file.error();
  for (std::size_t i = 0; i < file->fields.size(); ++i) {
    coverage::Task one = task;
    if (i < file->origins.size()) one.origin = file->origins[i];
    one.no_fly = file->origins.empty() ? file->no_fly.front() : std::move(file->no_fly[i]);
    one.fields.push_back(std::move(file->fields[i]));
    start_at(one, on_ground(job.terrain, start_of(one.fields, one.no_fly)));
    if (const Status status = set_ways(fields, job.terrain, one); !status) return status.error();
    job.tasks.push_back(std::move(one));
  }
  return job;
}

}  // namespace swallowtail::cli
