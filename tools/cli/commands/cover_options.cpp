#include "tools/cli/commands/cover_options.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/core.h>

#include "planner/base/checks.hpp"

namespace swallowtail::cli {
namespace {

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
  coverage::RobotBattery& own = options.fields.task.charger.battery;
  group
      .add_option("--robot-capacity", own.capacity,
                  "Units of its own battery, refilled where it starts; without this it has no end")
      ->check(CLI::PositiveNumber);
  group.add_option("--robot-drive-per-s", own.drive_per_s, "Units for each second that it drives")
      ->check(CLI::NonNegativeNumber);
  group
      .add_option("--robot-per-charged", own.per_charged, "Units for each that the aircraft is charged with")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  group.add_option("--robot-refill", own.refill_s, "Seconds to refill it")->check(CLI::NonNegativeNumber);
  group.add_option("--robot-reserve", own.reserve, "Units of it that the robot keeps")
      ->check(CLI::NonNegativeNumber);
}

}  // namespace

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

void add_fleet_options(CLI::App& command, CoverOptions& options) {
  coverage::FleetOptions& fleet = options.fleet;
  fleet.aircraft = 1;
  command
      .add_option("--aircraft", fleet.aircraft,
                  "So many aircraft, each with its own ground robot, share each mission and start side by "
                  "side; fewer "
                  "where more would take longer than one")
      ->check(CLI::Range(1, coverage::kMaxAircraft))
      ->capture_default_str();
  command.add_option("--start", options.starts,
                     "EAST,NORTH: where an aircraft starts, metres from the mission's origin; one for each");
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
  for (const std::string& text : options.class_heights) {
    if (const Status status = add_class_height(text, fields.class_heights_m); !status) return status;
  }
  return {};
}

Status set_starts(CoverOptions& options, CoverJob& job) {
  if (options.starts.empty()) return {};
  if (job.tasks.size() != 1)
    return bad_input("--start: there are several missions; choose one by --field or --mission one.");
  for (const std::string& text : options.starts) {
    const std::size_t comma = text.find(',');
    Vec2 start = Vec2::Zero();
    if (comma == std::string::npos || !CLI::detail::lexical_cast(text.substr(0, comma), start.x()) ||
        !CLI::detail::lexical_cast(text.substr(comma + 1), start.y()) || !is_finite(start))
      return bad_input(fmt::format("--start {}: must be EAST,NORTH in metres.", text));
    options.fleet.starts_m.push_back(start);
  }
  const auto count = static_cast<int>(options.starts.size());
  if (options.fleet.aircraft == 1) options.fleet.aircraft = count;
  if (count != options.fleet.aircraft) {
    return bad_input(
        fmt::format("--start: there are {} for {} aircraft (--aircraft).", count, options.fleet.aircraft));
  }
  coverage::Task& task = job.tasks.front();
  const bool is_together = (task.start_m - task.charger.start_m).head<2>().norm() < 1.0;
  const Vec2& first = options.fleet.starts_m.front();
  task.start_m = Vec3(first.x(), first.y(), job.terrain.height_at(first.x(), first.y()));
  if (is_together) task.charger.start_m = task.start_m;
  return {};
}

}  // namespace swallowtail::cli
