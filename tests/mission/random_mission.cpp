#include "tests/mission/random_mission.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <numbers>
#include <set>
#include <variant>

#include "charger/participant/charger_participant.hpp"
#include "coverage/participant/coverage_participant.hpp"
#include "planner/base/rng.hpp"
#include "planner/participant/planner_participant.hpp"
#include "qos/memory/bus.hpp"
#include "tests/mission/random_kinds.hpp"
#include "tests/mission/random_obstacles.hpp"
#include "tools/mission/check/flight_check.hpp"
#include "tools/mission/check/rules_of.hpp"
#include "tools/sim/sim_participant.hpp"

namespace swallowtail::mission {
namespace {

constexpr double kTick_s = 0.01;       // wall time
constexpr double kLongest_s = 8000.0;  // mission time
constexpr double kForever_s = 1e6;
constexpr double kReaction_s = 0.4;  // wall time until the aircraft flies a changed plan
const std::set<std::string> kRobotRules{"robot_energy", "closed_ground", "off_road"};

/// Star-shaped around its centre, concave as a rule, sometimes with a hole.
coverage::Polygon random_field(Rng& rng, const Vec2& centre, double radius_m) {
  coverage::Polygon out;
  const int corners = 4 + static_cast<int>(rng.below(7));
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.6 * rng.uniform()) / corners;
    out.outline.push_back(centre + radius_m * rng.uniform(0.6, 1.0) * Vec2(std::cos(angle), std::sin(angle)));
  }
  if (rng.uniform() < 0.4) {
    coverage::Ring hole;
    const int sides = 3 + static_cast<int>(rng.below(4));
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      hole.push_back(centre + 0.2 * radius_m * Vec2(std::cos(angle), std::sin(angle)));
    }
    out.holes.push_back(hole);
  }
  return out;
}

nlohmann::json ring_json(coverage::Ring ring) {
  ring.push_back(ring.front());
  nlohmann::json out = nlohmann::json::array();
  for (const Vec2& p : ring) out.push_back({p.x(), p.y()});
  return out;
}

void draw_task(Rng& rng, RandomMission& mission) {
  planner::Scenario& scenario = mission.scenario;
  scenario.name = "random " + std::to_string(mission.seed);
  scenario.bounds = {Vec3(-200.0, -200.0, -1.0), Vec3(400.0, 250.0, 60.0)};
  const int fields = rng.uniform() < 0.25 ? 2 : 1;
  for (int f = 0; f < fields; ++f) {
    const Vec2 centre(150.0 * f + rng.uniform(-20.0, 20.0), rng.uniform(-20.0, 20.0));
    mission.fields.push_back(random_field(rng, centre, rng.uniform(35.0, 70.0)));
  }
  auto& limits = scenario.vehicle.limits;
  limits.cruise_speed_mps = rng.uniform(5.0, 10.0);
  limits.climb_speed_mps = rng.uniform(2.0, 4.0);
  limits.descent_speed_mps = rng.uniform(1.5, 3.5);
  planner::CoverageSpec& spec = scenario.coverage.emplace();
  spec.sensor_width_m = rng.uniform(9.0, 20.0);
  spec.heights.default_m = rng.uniform(6.0, 30.0);
  spec.battery.capacity = rng.uniform(80.0, 220.0);
  spec.battery.reserve = rng.uniform(0.06, 0.15) * spec.battery.capacity;
  spec.battery.charge_s_per_unit = rng.uniform(0.1, 0.6);
  spec.charger.speed_mps = rng.uniform(1.5, 4.0);
  spec.charger.start_m = Vec2(rng.uniform(-110.0, -70.0), rng.uniform(-80.0, 80.0));
  mission.rate = rng.uniform() < 0.5 ? 5.0 : 15.0;
}

void draw_battery_faults(Rng& rng, RandomMission& mission) {
  planner::Scenario& scenario = mission.scenario;
  const double kind = rng.uniform();
  if (kind < 0.5) {
    mission.consumption = rng.uniform(0.92, 1.06);
  } else if (kind < 0.8) {
    mission.consumption = rng.uniform(1.06, 1.25);
  } else if (kind < 0.9) {
    mission.consumption = rng.uniform(1.25, 1.6);
  }
  if (rng.uniform() < 0.25) mission.capacity_share = rng.uniform(0.7, 1.0);
  scenario.battery_noise = rng.uniform(0.0, 0.08);
  if (rng.uniform() < 0.5) {
    scenario.wind = {rng.uniform(0.0, 3.0), rng.uniform(0.0, 2.0 * std::numbers::pi), rng.uniform(0.0, 1.5)};
  }
  for (double time_s = 0.0; rng.uniform() < 0.3;) {
    time_s += rng.uniform(10.0, 250.0);
    const double loss = rng.uniform(0.05, 0.5) * scenario.coverage->battery.capacity;
    scenario.events.push_back({time_s, planner::BatteryLoss{loss}});
    mission.faults += "loss of " + std::to_string(loss) + " at " + std::to_string(time_s) + " s; ";
  }
  mission.faults += "consumption " + std::to_string(mission.consumption) + "; capacity " +
                    std::to_string(mission.capacity_share) + "; ";
}

void draw_robot_faults(Rng& rng, RandomMission& mission) {
  const double kind = rng.uniform();
  const double from_s = rng.uniform(5.0, 400.0);
  if (kind < 0.4) return;
  if (kind < 0.55) {
    mission.delays.push_back({from_s, rng.uniform(10.0, 300.0)});
    mission.faults += "robot stands still; ";
  } else if (kind < 0.65) {
    const double stands_s = rng.uniform(1.0, 4.0);
    for (double t = 0.0; t < kLongest_s; t += 6.0) mission.delays.push_back({t, stands_s});
    mission.faults += "robot slow; ";
  } else if (kind < 0.8) {
    mission.silences.push_back({from_s, from_s + rng.uniform(10.0, 300.0)});
    mission.faults += "robot lost for a while; ";
  } else if (kind < 0.9) {
    mission.delays.push_back({from_s, kForever_s});
    mission.robot_dies_s = from_s;
    mission.faults += "robot stands still for good from " + std::to_string(from_s) + " s; ";
  } else {
    mission.silences.push_back({from_s, kForever_s});
    mission.robot_dies_s = from_s;
    mission.faults += "robot lost for good from " + std::to_string(from_s) + " s; ";
  }
}

/// Small and convex, each in a field of its own drawing or across its border.
void draw_no_fly(Rng& rng, RandomMission& mission) {
  const std::uint64_t count = rng.uniform() < 0.4 ? 1 + rng.below(3) : 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const coverage::Polygon& field = mission.fields[rng.below(mission.fields.size())];
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : field.outline) middle += p / static_cast<double>(field.outline.size());
    const Vec2& corner = field.outline[rng.below(field.outline.size())];
    const Vec2 centre = middle + rng.uniform(0.3, 1.0) * (corner - middle);
    const double radius_m = rng.uniform(3.0, 12.0);
    const double turn = rng.uniform(0.0, 2.0 * std::numbers::pi);
    coverage::Polygon area;
    const int corners = 3 + static_cast<int>(rng.below(4));
    for (int k = 0; k < corners; ++k) {
      const double angle = turn + 2.0 * std::numbers::pi * k / corners;
      area.outline.push_back(centre + radius_m * Vec2(std::cos(angle), std::sin(angle)));
    }
    mission.no_fly.push_back(area);
  }
  if (count > 0) mission.faults += std::to_string(count) + " no-fly areas; ";
}

/// Of the robot's own, in which losses are no more than its reserve, but for one before it sets out.
void draw_robot_battery(Rng& rng, RandomMission& mission) {
  if (rng.uniform() >= 0.3) return;
  planner::Scenario& scenario = mission.scenario;
  planner::ChargerSpec& charger = scenario.coverage->charger;
  planner::RobotBatterySpec own;
  own.drive_per_s = rng.uniform(0.0, 0.1);
  own.per_charged = rng.uniform(0.9, 1.3);
  own.refill_s = rng.uniform(0.0, 90.0);
  // To the farthest place, on, and home.
  const double farthest_s = 3.0 * 450.0 / charger.speed_mps;
  own.capacity = own.drive_per_s * farthest_s +
                 rng.uniform(0.6, 3.0) * own.per_charged * scenario.coverage->battery.capacity;
  own.reserve = rng.uniform(0.05, 0.15) * own.capacity;
  own.capacity += own.reserve;
  charger.battery = own;
  mission.faults += "robot's battery of " + std::to_string(own.capacity) + "; ";
  if (rng.uniform() < 0.4) mission.losses.push_back({0.0, rng.uniform(0.1, 0.8) * own.capacity});
  if (rng.uniform() < 0.4) mission.losses.push_back({rng.uniform(20.0, 400.0), 0.9 * own.reserve});
  for (const charger::Loss& loss : mission.losses)
    scenario.events.push_back({loss.at_s, planner::ChargerLoss{loss.energy}});
  std::ranges::stable_sort(scenario.events, {}, &planner::Event::at_s);
}

void draw_replacement(Rng& rng, RandomMission& mission) {
  if (rng.uniform() >= 0.15) return;
  const planner::BatterySpec& battery = mission.scenario.coverage->battery;
  planner::AircraftReplaced other;
  other.capacity = rng.uniform(0.75, 1.0) * battery.capacity;
  other.energy = rng.uniform(0.5, 1.0) * *other.capacity;
  if (rng.uniform() < 0.5) other.start_m = Vec2(rng.uniform(-120.0, 100.0), rng.uniform(-100.0, 100.0));
  const double at_s = rng.uniform(20.0, 500.0);
  mission.scenario.events.push_back({at_s, other});
  std::ranges::stable_sort(mission.scenario.events, {}, &planner::Event::at_s);
  mission.faults += "another aircraft from " + std::to_string(at_s) + " s; ";
}

class ClosedLoop {
 public:
  explicit ClosedLoop(const RandomMission& mission) : mission_(mission) { watch(); }

  MissionEnd run() {
    const auto charger_bus = network_.make_bus();
    const auto coverage_bus = network_.make_bus();
    const auto planner_bus = network_.make_bus();
    const auto sim_bus = network_.make_bus();
    const auto charger =
        charger::ChargerParticipant::make(
            *charger_bus, clock_, {.charger_id = 1, .delays = mission_.delays, .losses = mission_.losses})
            .value();
    const auto coverage = coverage::CoverageParticipant::make(*coverage_bus, clock_, {}).value();
    const auto planner =
        planner::PlannerParticipant::make(*planner_bus, clock_,
                                          {.obstacle_acceleration_mps2 = mission_.obstacle_acceleration_mps2})
            .value();
    auto made = sim::SimParticipant::make(*sim_bus, clock_, mission_.scenario,
                                          {.rate = mission_.rate,
                                           .await = {1, 2, 3},
                                           .await_limit_s = 5.0,
                                           .max_time_s = kLongest_s,
                                           .seed = mission_.seed,
                                           .consumption = mission_.consumption,
                                           .capacity_share = mission_.capacity_share});
    const auto sim = std::move(made).value();
    for (bool more = true; more;) {
      clock_.advance(kTick_s);
      const auto stepped = sim->step();
      more = stepped.ok() && *stepped;
      judge_reserve(sim->simulation());
      if (!is_silent()) expect(charger->step());
      expect(coverage->step());
      expect(planner->step());
      expect(planner->beat());
    }
    end_.summary = nlohmann::json::parse(sim->summary());
    judge_robot();
    return std::move(end_);
  }

 private:
  void watch() {
    (void)bus_->subscribe<data::CoveragePlan>({.on_sample = [this](const data::CoveragePlan& plan) {
      end_.plan = plan;
      end_.reasons.push_back(plan.reason);
    }});
    (void)bus_->subscribe<data::ParticipantStatus>({.on_sample = [this](const data::ParticipantStatus& s) {
      if (s.participant_id == data::kCoverageId) end_.health = s.message;
    }});
    (void)bus_->subscribe<data::ChargerState>({.on_sample = [this](const data::ChargerState& state) {
      if (!robot_.chargers.empty() && state.energy > robot_.chargers.back().energy) ++end_.refills;
      robot_.chargers.push_back(state);
    }});
  }

  void expect(const Status& stepped) {
    if (!stepped && end_.failures.size() < 10) end_.failures.push_back(stepped.error().message);
  }

  void judge_robot() {
    const auto rules = check::rules_of(mission_.scenario);
    if (!rules) return end_.robot_faults.push_back(rules.error().message);
    for (const check::Finding& finding : check::check_flight(robot_, *rules).violations)
      if (kRobotRules.contains(finding.kind))
        end_.robot_faults.push_back(std::to_string(finding.time_s) + " s: " + finding.detail);
  }

  /// What going straight down from here takes once the loss is known: until the next battery sample, until
  /// the change reaches the aircraft, to stop, and down; at the truest power, in the worst wind.
  double to_come_down(const planner::Scenario& scenario, double height_m) const {
    const double power =
        greatest_rate(scenario) * mission_.consumption *
        (1.0 + 2.5 * scenario.battery_noise +
         (scenario.wind.speed_mps + scenario.wind.gust_mps) / scenario.vehicle.limits.cruise_speed_mps);
    const double known_s = 1.0 + 2.0 * kReaction_s * mission_.rate;
    return power * (known_s + 1.0 + height_m / scenario.vehicle.limits.descent_speed_mps);
  }

  void judge_reserve(const sim::Simulation& simulation) {
    const planner::Scenario& scenario = mission_.scenario;
    const double reserve = scenario.coverage->battery.reserve;
    const double energy = simulation.battery()->energy();
    const bool aloft = !simulation.motion().on_ground();
    time_s_ = simulation.time_s();
    if (!aloft) {
      breached_ = false;
      // A take-off that was decided before the loss was known cannot be called back.
      doomed_ = energy < reserve && time_s_ < ground_loss_s_ + 1.0 + 2.0 * kReaction_s * mission_.rate;
    }
    while (losses_ < scenario.events.size() && scenario.events[losses_].at_s <= time_s_) {
      const bool is_loss = std::holds_alternative<planner::BatteryLoss>(scenario.events[losses_].what);
      ++losses_;
      if (!is_loss) continue;
      if (!aloft) ground_loss_s_ = time_s_;
      if (aloft && energy - to_come_down(scenario, simulation.motion().position_m.z()) < reserve)
        doomed_ = true;
    }
    if (!aloft || breached_ || energy >= reserve) return;
    breached_ = true;
    end_.breaches.push_back({time_s_, energy, doomed_});
  }

  bool is_silent() const {
    return std::any_of(mission_.silences.begin(), mission_.silences.end(),
                       [this](const Silence& s) { return time_s_ >= s.from_s && time_s_ < s.to_s; });
  }

  const RandomMission& mission_;
  ManualClock clock_;
  MemoryNetwork network_;
  const std::unique_ptr<Bus> bus_ = network_.make_bus();
  MissionEnd end_;
  check::FlightLog robot_;
  double time_s_ = 0.0;
  std::size_t losses_ = 0;
  bool breached_ = false;  ///< in this flight
  bool doomed_ = false;
  double ground_loss_s_ = -kForever_s;
};

}  // namespace

void write_polygons(const std::vector<coverage::Polygon>& fields, const std::string& file) {
  nlohmann::json features = nlohmann::json::array();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    nlohmann::json rings = nlohmann::json::array({ring_json(fields[i].outline)});
    for (const coverage::Ring& hole : fields[i].holes) rings.push_back(ring_json(hole));
    const std::string name = "f" + std::to_string(i);
    features.push_back({{"type", "Feature"},
                        {"properties", {{"id", name}, {"class", name}, {"crs", "local metres"}}},
                        {"geometry", {{"type", "Polygon"}, {"coordinates", rings}}}});
  }
  std::ofstream(file) << nlohmann::json{{"type", "FeatureCollection"}, {"features", features}};
}

RandomMission random_mission(std::uint64_t seed, const std::string& folder) {
  RandomMission mission;
  mission.seed = seed;
  Rng rng(seed);
  draw_task(rng, mission);
  draw_battery_faults(rng, mission);
  draw_robot_faults(rng, mission);
  // Drawn apart: the missions are else as they were.
  Rng more(seed * 7919 + 1);
  draw_no_fly(more, mission);
  draw_robot_battery(more, mission);
  draw_replacement(more, mission);
  std::filesystem::create_directories(folder);
  Rng kinds(seed * 7919 + 2);
  draw_kinds(kinds, mission, folder);
  Rng world(seed * 104729 + 2);
  draw_obstacles(world, mission);
  mission.scenario.coverage->fields_file = folder + "/" + std::to_string(seed) + ".geojson";
  write_polygons(mission.fields, mission.scenario.coverage->fields_file);
  if (mission.no_fly.empty()) return mission;
  mission.scenario.coverage->no_fly_file = folder + "/" + std::to_string(seed) + "_no_fly.geojson";
  write_polygons(mission.no_fly, mission.scenario.coverage->no_fly_file);
  return mission;
}

MissionEnd fly(const RandomMission& mission) { return ClosedLoop(mission).run(); }

}  // namespace swallowtail::mission
