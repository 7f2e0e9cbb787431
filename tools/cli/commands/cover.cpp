#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "coverage/fleet/fleet.hpp"
#include "planner/base/checks.hpp"
#include "planner/base/clock.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/cover_answer.hpp"
#include "tools/cli/cover_files.hpp"
#include "tools/cli/cover_run.hpp"
#include "tools/cli/cover_task.hpp"
#include "tools/cli/input.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"

namespace swallowtail::cli {
namespace {

struct CoverOptions {
  Common common;
  std::string file;
  FieldsJob fields;
  gtsp::Mode mode = gtsp::Mode::kFast;
  double time_limit_s = 0.0;
  bool compare_full_graph = false;
  coverage::FleetOptions fleet{1, {}, nullptr};
  bool has_sensor_width = false;
  std::vector<std::string> class_heights;  ///< NAME=METRES
  bool is_multirotor = false;
  coverage::Multirotor craft;
  double wind_mps = 0.0;
  double wind_to_deg = 0.0;
  planner::RoadSpec roads;
  planner::RoughGroundSpec rough;
  std::optional<double> slope_max_deg;
};

/// Energy model and the ground robot's ways, as far as they are put together from several options.
Status complete(CoverOptions& options) {
  FieldsJob& fields = options.fields;
  if (options.is_multirotor) {
    const double to_rad = options.wind_to_deg * std::numbers::pi / 180.0;
    fields.task.battery.model.multirotor = options.craft;
    fields.task.battery.model.wind_mps = options.wind_mps * Vec2(std::sin(to_rad), std::cos(to_rad));
  } else if (options.wind_mps > 0.0) {
    return bad_input("--wind-speed: only --energy-model multirotor knows what wind takes.");
  }
  const bool is_rough = options.slope_max_deg || !options.rough.forbidden_file.empty();
  if (!options.roads.file.empty() && is_rough)
    return bad_input("--roads does not go with --slope-max-deg or --forbidden.");
  if (!options.roads.file.empty()) fields.ways.ground = options.roads;
  if (is_rough) {
    options.rough.slope_max_rad = options.slope_max_deg.value_or(80.0) * std::numbers::pi / 180.0;
    fields.ways.ground = options.rough;
  }
  return {};
}

/// NAME=METRES to its two sides.
Status add_class_height(const std::string& text, std::map<std::string, double>& out) {
  const std::size_t at = text.rfind('=');
  double height_m = 0.0;
  if (at == std::string::npos || at == 0 || !CLI::detail::lexical_cast(text.substr(at + 1), height_m) ||
      !is_positive(height_m)) {
    return bad_input(fmt::format("--class-height {}: must be NAME=METRES.", text));
  }
  out[text.substr(0, at)] = height_m;
  return {};
}

coverage::PlanOptions plan_options(const CoverOptions& options, const Clock& clock, double deadline_s,
                                   int threads) {
  coverage::PlanOptions out;
  out.seed = options.common.seed;
  out.mode = options.mode;
  out.clock = &clock;
  out.stop.clock = &clock;
  out.stop.deadline_s = deadline_s;
  out.stop.stop_requested = &interrupted();
  out.full_graph = options.compare_full_graph ? coverage::FullGraph::kCompare : coverage::FullGraph::kSkip;
  out.threads = threads;
  return out;
}

/// Several tasks are shared out over the threads, a single one gets them all. The same answer for any number
/// of threads.
std::vector<Covered> cover_all(const CoverOptions& options, const CoverJob& job, const Clock& clock,
                               Progress& progress) {
  const double deadline_s = options.time_limit_s > 0.0 ? clock.now_s() + options.time_limit_s
                                                       : std::numeric_limits<double>::infinity();
  const auto count = static_cast<int>(job.tasks.size());
  const auto plan = plan_options(options, clock, deadline_s, count == 1 ? options.common.threads : 1);
  std::vector<std::vector<Covered>> by_task(job.tasks.size());
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) {
      const auto at = static_cast<std::size_t>(i);
      if (interrupted()) {
        by_task[at].emplace_back();
        by_task[at].back().task = &job.tasks[at];
        by_task[at].back().reason = "Interrupted before this field was planned.";
        continue;
      }
      by_task[at] = cover_task(job.tasks[at], job.terrain, plan, options.fleet);
      progress.update(fmt::format("{} of {} tasks", i + 1, count));
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < std::min(options.common.threads, count); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  std::vector<Covered> done;
  for (std::vector<Covered>& parts : by_task) std::ranges::move(parts, std::back_inserter(done));
  return done;
}

bool is_scenario(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  return extension == ".yaml" || extension == ".yml";
}

std::optional<CoverJob> read_job(CoverOptions& options, Exit& exit) {
  exit = Exit::kUsage;
  auto job = [&]() -> std::optional<Result<CoverJob>> {
    if (is_scenario(options.file)) {
      const auto scenario = read_scenario_or_tell(options.file);
      if (!scenario) return std::nullopt;
      return job_of(*scenario, options.common.seed);
    }
    if (!options.has_sensor_width) return bad_input("cover: a fields file needs --sensor-width.");
    if (const Status status = complete(options); !status) return status.error();
    for (const std::string& text : options.class_heights) {
      if (const Status status = add_class_height(text, options.fields.class_heights_m); !status.ok())
        return status.error();
    }
    options.fields.file = options.file;
    options.fields.task.seed = options.common.seed;
    const coverage::FieldRules& rules = options.fields.task.rules;
    if (rules.headland != coverage::Headland::kNone && rules.headland_m <= 0.0)
      return bad_input("cover: --headland needs --headland-width.");
    return job_of(options.fields);
  }();
  if (!job) return std::nullopt;
  if (!*job) {
    exit = fail(job->error());
    return std::nullopt;
  }
  return std::move(job->value());
}

/// Tells before any work is done that a .plan cannot hold the answer.
Status check_plan_file(const std::string& output, const CoverJob& job) {
  if (std::filesystem::path(output).extension() != ".plan") return {};
  std::vector<Covered> unplanned;
  for (const coverage::Task& task : job.tasks) unplanned.push_back({&task, coverage::Plan(), "", 0.0});
  if (unplanned.size() == 1 && unplanned.front().task->origin) return {};
  const auto refused = cover_qgc_plan(unplanned);
  return refused ? Status() : Status(refused.error());
}

Exit run_cover(CoverOptions& options) {
  const Status output = check_output(options.common, {".json", ".csv", ".geojson", ".kml", ".plan", ".svg"});
  if (!output.ok()) return fail(output.error());
  Exit exit = Exit::kDone;
  const auto job = read_job(options, exit);
  if (!job) return exit;
  for (const coverage::Task& task : job->tasks) {
    if (const Status status = coverage::validate(task); !status.ok()) return fail(status.error());
  }
  if (const Status status = check_plan_file(options.common.output, *job); !status.ok())
    return fail(status.error());
  const SteadyClock clock;
  const double begin_s = clock.now_s();
  std::vector<Covered> done;
  {
    Progress progress("cover", options.common.quiet ? Progress::Show::kNo : Progress::Show::kYes);
    done = cover_all(options, *job, clock, progress);
  }
  const CoverStatus status = interrupted() ? CoverStatus::kInterrupted : status_of(done);
  const std::map<CoverStatus, Exit> exits = {{CoverStatus::kCertified, Exit::kDone},
                                             {CoverStatus::kPartial, Exit::kNone},
                                             {CoverStatus::kInfeasible, Exit::kNone},
                                             {CoverStatus::kInterrupted, Exit::kInterrupted}};
  return deliver(options.common, answer_of(*job, done, status, clock.now_s() - begin_s), exits.at(status));
}

void add_rules_options(CLI::App& group, FieldsJob& fields) {
  coverage::FieldRules& rules = fields.task.rules;
  const std::map<std::string, coverage::Headland> headlands = {{"none", coverage::Headland::kNone},
                                                               {"skip", coverage::Headland::kSkip},
                                                               {"fly", coverage::Headland::kFly}};
  group.add_option("--no-fly", fields.no_fly_file, "Vector file of areas neither covered nor crossed");
  group.add_option("--overlap", rules.overlap, "Share of the sensor's width that neighbouring strips share")
      ->check(CLI::Range(0.0, 0.9))
      ->capture_default_str();
  group.add_option("--headland", rules.headland, "A band along the border: fly along it first, or skip it")
      ->transform(CLI::CheckedTransformer(headlands))
      ->option_text("none|skip|fly");
  group.add_option("--headland-width", rules.headland_m, "Its width, m")->check(CLI::PositiveNumber);
  group.add_flag_callback(
      "--allow-outside", [&rules] { rules.beyond = coverage::Beyond::kSlantedBorders; },
      "Lines may leave the field over slanted borders, by half a sensor sideways");
  group.add_option("--ceiling", rules.ceiling_m, "Greatest lawful height above ground, m")
      ->check(CLI::PositiveNumber);
}

void add_energy_options(CLI::App& group, CoverOptions& options) {
  coverage::Battery& battery = options.fields.task.battery;
  const std::map<std::string, bool> models = {{"document", false}, {"multirotor", true}};
  group
      .add_option("--energy-model", options.is_multirotor,
                  "One unit for each second aloft, or a multirotor by momentum theory with units of a Wh")
      ->transform(CLI::CheckedTransformer(models))
      ->option_text("document|multirotor");
  group.add_option("--mass", options.craft.mass_kg, "The multirotor without payload, kg")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  group.add_option("--payload", options.craft.payload_kg, "kg")->check(CLI::NonNegativeNumber);
  group.add_option("--rotors", options.craft.rotors, "Rotors of the multirotor")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  group.add_option("--rotor-radius", options.craft.rotor_radius_m, "m")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  group.add_option("--wind-speed", options.wind_mps, "Constant wind that the multirotor flies in, m/s")
      ->check(CLI::NonNegativeNumber);
  group.add_option("--wind-to-deg", options.wind_to_deg, "Where it blows to, clockwise from north");
  group
      .add_option("--altitude-factor", battery.model.altitude_per_m,
                  "Share by which consumption grows per metre of height")
      ->check(CLI::NonNegativeNumber);
  group
      .add_option("--taper-from", battery.taper_from,
                  "Share of the capacity above which charging slows down (constant voltage)")
      ->check(CLI::Range(0.0, 1.0));
  group.add_option("--taper-end-rate", battery.taper_end_rate, "Share of the charging rate left when full")
      ->check(CLI::Range(0.001, 1.0))
      ->capture_default_str();
}

void add_ground_options(CLI::App& group, CoverOptions& options) {
  group.add_option("--roads", options.roads.file, "Lines that the ground robot drives along, a vector file");
  group
      .add_option("--off-road-speed", options.roads.off_road_speed_mps,
                  "Its speed between a site and the road, m/s; 0: it does not leave the road")
      ->check(CLI::NonNegativeNumber);
  group.add_option("--off-road-max", options.roads.off_road_max_m, "No farther from the road, m")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  group.add_option("--slope-max-deg", options.slope_max_deg, "Steepest ground that it drives over")
      ->check(CLI::Range(0.0, 85.0));
  group.add_option("--forbidden", options.rough.forbidden_file, "Polygons that it does not drive over");
}

void add_fields_options(CLI::App& command, CoverOptions& options) {
  FieldsJob& fields = options.fields;
  const std::map<std::string, FieldsJob::Split> splits = {
      {"auto", FieldsJob::Split::kAuto}, {"one", FieldsJob::Split::kOne}, {"each", FieldsJob::Split::kEach}};
  auto* group = command.add_option_group("fields", "For a fields file; a scenario says these itself");
  group->add_option("--sensor-width", fields.task.sensor_width_m, "Width that the sensor sees, m")
      ->check(CLI::PositiveNumber)
      ->each([&options](const std::string&) { options.has_sensor_width = true; });
  group->add_option("--height", fields.default_height_m, "Flying height above ground, m")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  group->add_option("--class-height", options.class_heights,
                    "Height for fields of a class, NAME=METRES; repeatable");
  group->add_option("--field", fields.field_ids, "Only this field, by id; repeatable");
  group
      ->add_option("--mission", fields.split,
                   "All fields in one mission, or each in its own; auto: one within 3 km")
      ->transform(CLI::CheckedTransformer(splits))
      ->option_text("auto|one|each");
  group->add_option("--sweep-deg", fields.sweep_deg,
                    "Flying direction, counter-clockwise from east, instead of the cheapest");
  add_rules_options(*group, fields);
  group->add_option("--speed", fields.task.vehicle.cruise_speed_mps, "Cruise speed, m/s")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  group->add_option("--capacity", fields.task.battery.capacity, "Battery capacity, units")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  group->add_option("--reserve", fields.task.battery.reserve, "Units never used")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  group->add_option("--levels", fields.task.battery.levels, "Battery levels of the graph")
      ->check(CLI::Range(2, 100))
      ->capture_default_str();
  group
      ->add_option("--charge-s-per-unit", fields.task.battery.charge_s_per_unit, "Seconds to charge one unit")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  group->add_option("--charger-speed", fields.task.charger.speed_mps, "Speed of the ground robot, m/s")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_energy_options(*group, options);
  add_ground_options(*group, options);
  group->add_option("--neighbours", fields.task.neighbours, "Neighbours kept for each sub-cell")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

void add_fleet_options(CLI::App& command, coverage::FleetOptions& fleet) {
  command
      .add_option(
          "--aircraft", fleet.aircraft,
          "So many aircraft, each with its own ground robot, share each mission and start side by side")
      ->check(CLI::Range(1, coverage::kMaxAircraft))
      ->capture_default_str();
  command.add_option("--apart", fleet.separation.horizontal_m, "Aircraft aloft keep so far apart, m, or")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--apart-vertical", fleet.separation.vertical_m, "one so far above the other, m")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--apart-landed", fleet.separation.landed_m,
                  "Instead of --apart to one that has landed, or among landed ones and robots, m")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

}  // namespace

void add_cover(CLI::App& app, Exit& exit) {
  CLI::App* command =
      app.add_subcommand("cover", "Plan the coverage of fields with recharging on a ground robot");
  const auto options = std::make_shared<CoverOptions>();
  const std::map<std::string, gtsp::Mode> modes = {
      {"fast", gtsp::Mode::kFast}, {"default", gtsp::Mode::kDefault}, {"slow", gtsp::Mode::kSlow}};
  command->add_option("FILE", options->file, "Scenario (.yaml), or fields (.geojson, .kml, …)")->required();
  command->add_option("--mode", options->mode, "How long the tour search goes on: fast, default or slow")
      ->transform(CLI::CheckedTransformer(modes))
      ->option_text("fast|default|slow");
  command
      ->add_option("--time-limit", options->time_limit_s,
                   "Stop after so many seconds with the best plan so far")
      ->check(CLI::PositiveNumber);
  command->add_flag("--compare-full-graph", options->compare_full_graph,
                    "Also solve the graph with all edges, for full_graph_gap_percent");
  add_fleet_options(*command, options->fleet);
  add_fields_options(*command, *options);
  add_common(*command, options->common,
             "  swallowtail cover tests/data/missions/two_heights.yaml\n"
             "  swallowtail cover fields.geojson --sensor-width 10 --height 25 --json\n"
             "  swallowtail cover parcels.geojson --sensor-width 12 --field nl-3-0 -o legs.geojson\n"
             "  swallowtail cover field.kml --sensor-width 8 --no-fly ponds.geojson -o mission.plan\n"
             "  swallowtail cover field.kml --sensor-width 10 --aircraft 3 --apart 15 -o mission.plan\n"
             "  (which writes mission-1.plan, mission-2.plan and mission-3.plan)\n"
             "  -o writes .json, .csv (legs), .geojson or .kml (legs, transfers, rendezvous), .plan\n"
             "  (QGroundControl) or .svg (a picture)");
  command->callback([options, &exit] { exit = run_cover(*options); });
}

}  // namespace swallowtail::cli
