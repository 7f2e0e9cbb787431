#include "tools/sim/sim_participant.hpp"

#include <cmath>
#include <utility>

#include "planner/base/checks.hpp"
#include "tools/sim/convert.hpp"

namespace swallowtail::sim {
namespace {

constexpr std::uint64_t kStepsPerVehicleState = 2;   // 0.1 s of mission time
constexpr std::uint64_t kStepsPerBatteryState = 20;  // 1 s
constexpr int kFarewells = 10;
constexpr double kGrace_s = 2.0;        // mission time …
constexpr double kGraceWall_s = 1.0;    // … or wall time, whichever is longer: coverage may still add legs
constexpr std::size_t kMaxTiles = 512;  // instances of the topic

template <class T>
Status open(Bus& bus, std::unique_ptr<Publisher<T>>& publisher) {
  auto made = bus.publisher<T>();
  if (!made) return made.error();
  publisher = std::move(made).value();
  return {};
}

/// The first of several that fails.
template <class... Statuses>
Status first_failure(Statuses... statuses) {
  Status result;
  ((result = result ? std::move(statuses) : std::move(result)), ...);
  return result;
}

}  // namespace

Status validate(const SimOptions& options) {
  if (!is_positive(options.rate)) return bad_input("The rate must be positive.");
  if (!is_positive(options.await_limit_s)) return bad_input("The limit for awaiting must be positive.");
  if (!is_positive(options.consumption)) return bad_input("The consumption must be positive.");
  if (!(options.capacity_share > 0.0 && options.capacity_share <= 1.0))
    return bad_input("The share of the capacity that the battery holds must lie in (0, 1].");
  if (!(options.max_time_s > 0.0)) return bad_input("The greatest mission time must be positive.");
  return {};
}

Result<std::unique_ptr<SimParticipant>> SimParticipant::make(Bus& bus, const Clock& clock,
                                                             const planner::Scenario& scenario,
                                                             SimOptions options) {
  if (Status valid = validate(options); !valid) return valid.error();
  auto simulation = Simulation::make(scenario, {.seed = options.seed,
                                                .max_time_s = options.max_time_s,
                                                .grace_s = std::max(kGrace_s, kGraceWall_s * options.rate),
                                                .consumption = options.consumption,
                                                .capacity_share = options.capacity_share});
  if (!simulation) return simulation.error();
  std::unique_ptr<SimParticipant> sim(
      new SimParticipant(bus, clock, std::move(options), std::move(simulation).value()));
  if (Status done = sim->connect(); !done) return done.error();
  return sim;
}

SimParticipant::SimParticipant(Bus& bus, const Clock& clock, SimOptions options,
                               std::unique_ptr<Simulation> simulation)
    : bus_(bus),
      clock_(clock),
      options_(std::move(options)),
      simulation_(std::move(simulation)),
      pace_(options_.rate, Simulation::kStep_s),
      progress_due_(options_.progress_period_s) {}

Status SimParticipant::connect() {
  opened_s_ = clock_.now_s();
  auto status =
      StatusPublisher::make(bus_, clock_, {.participant_id = data::kSimulatorId, .name = "simulator"});
  if (!status) return status.error();
  status_ = std::move(status).value();
  Status opened =
      first_failure(open(bus_, tiles_), open(bus_, obstacles_), open(bus_, tasks_), open(bus_, goals_),
                    open(bus_, vehicles_), open(bus_, batteries_), open(bus_, clocks_));
  if (!opened) return opened;
  if (Status subscribed = subscribe(); !subscribed) return subscribed;
  if (Status published = publish_world(); !published) return published;
  status_->set_health(data::Health::kReady, "waits for the other participants");
  return {};
}

Status SimParticipant::subscribe() {
  Bus* bus = &bus_;
  const auto inbox = inbox_;
  const planner::Scenario& scenario = simulation_->scenario();
  const std::uint32_t vehicle_id = scenario.vehicle.id;
  const std::uint32_t charger_id = scenario.coverage ? scenario.coverage->charger.id : 0;
  return first_failure(
      bus_.subscribe<data::PathPlan>({.on_sample =
                                          [=](const data::PathPlan& plan) {
                                            if (plan.vehicle_id != vehicle_id)
                                              return bus->count_rejection("PathPlan", "unknown vehicle");
                                            inbox->path.put(plan);
                                          }}),
      bus_.subscribe<data::CoveragePlan>(
          {.on_sample =
               [=](const data::CoveragePlan& plan) {
                 if (plan.vehicle_id != vehicle_id)
                   return bus->count_rejection("CoveragePlan", "unknown vehicle");
                 if (plan.task_id != kTaskId)
                   return bus->count_rejection("CoveragePlan", "plan for another task");
                 inbox->coverage.put(plan);
               }}),
      bus_.subscribe<data::ChargerState>(
          {.on_sample =
               [=](const data::ChargerState& state) {
                 if (state.charger_id != charger_id)
                   return bus->count_rejection("ChargerState", "unknown charger");
                 if (state.docked_vehicle_id != 0 && state.docked_vehicle_id != vehicle_id) {
                   return bus->count_rejection("ChargerState", "unknown vehicle");
                 }
                 inbox->charger.put(state);
               }}),
      bus_.subscribe<data::ParticipantStatus>({.on_sample = [=](const data::ParticipantStatus& status) {
        const std::lock_guard lock(inbox->mutex);
        inbox->health[status.participant_id] = status.health;
      }}));
}

Status SimParticipant::publish_world() {
  const Mission& mission = simulation_->mission();
  const auto tiles = terrain_tiles(simulation_->terrain(), simulation_->scenario().bounds, mission.origin);
  if (tiles.size() > kMaxTiles) {
    return bad_input("The terrain needs " + std::to_string(tiles.size()) + " tiles of " +
                     std::to_string(kTileSide) + "² samples; at most " + std::to_string(kMaxTiles) +
                     " are sent. Use a coarser raster.");
  }
  for (const data::TerrainTile& tile : tiles) {
    if (Status sent = tiles_->publish(tile); !sent) return sent;
  }
  for (const planner::Obstacle& obstacle : simulation_->timeline().obstacles()) {
    const auto revision = simulation_->timeline().revision(obstacle.id);
    if (Status sent = obstacles_->publish(to_sample(obstacle, revision)); !sent) return sent;
  }
  Status asked = mission.task ? tasks_->publish(*mission.task) : goals_->publish(*mission.goal);
  if (!asked) return asked;
  return publish_due(clock_.now_s());
}

Status SimParticipant::publish_changes(const Changes& changes) {
  for (const planner::Obstacle& obstacle : changes.placed) {
    const auto revision = simulation_->timeline().revision(obstacle.id);
    if (Status sent = obstacles_->publish(to_sample(obstacle, revision)); !sent) return sent;
  }
  for (const planner::Obstacle& obstacle : changes.removed) {
    const auto revision = simulation_->timeline().revision(obstacle.id);
    if (Status sent = obstacles_->dispose(to_sample(obstacle, revision)); !sent) return sent;
  }
  return changes.energy_lost > 0.0 ? publish_battery() : Status();
}

Status SimParticipant::publish_vehicle() {
  const Motion& motion = simulation_->motion();
  data::VehicleState state;
  state.vehicle_id = simulation_->scenario().vehicle.id;
  state.time_s = simulation_->time_s();
  state.position = to_data(motion.position_m);
  state.velocity_mps = to_data(motion.velocity_mps);
  state.yaw_rad = motion.yaw_rad;
  state.mode = motion.mode;
  state.docked_charger_id = motion.docked_charger_id;
  state.path_revision = motion.path_revision;
  state.coverage_revision = motion.coverage_revision;
  state.leg_index = motion.leg_index;
  state.legs_done = motion.legs_done;
  return vehicles_->publish(state);
}

Status SimParticipant::publish_battery() {
  const Battery* battery = simulation_->battery();
  if (battery == nullptr) return {};
  return batteries_->publish({.vehicle_id = simulation_->scenario().vehicle.id,
                              .time_s = simulation_->time_s(),
                              .energy = battery->energy(),
                              .capacity = battery->capacity(),
                              .power = battery->power()});
}

Status SimParticipant::publish_due(double wall_s) {
  Status sent;
  if (clock_due_(wall_s)) {
    sent = clocks_->publish({.time_s = simulation_->time_s(), .rate = options_.rate, .state = state_});
  }
  if (sent && vehicle_due_(wall_s)) sent = publish_vehicle();
  if (sent && battery_due_(wall_s)) sent = publish_battery();
  return sent;
}

void SimParticipant::take_path(const data::PathPlan& plan) {
  has_path_ = true;
  switch (simulation_->offer(plan)) {
    case Offer::kStaleStart:
      return bus_.count_rejection("PathPlan", "stale start");
    case Offer::kNoWaypoints:
      return bus_.count_rejection("PathPlan", "flyable without waypoints");
    case Offer::kAccepted:
    case Offer::kKnown:
    case Offer::kNoSafePath:
      return;
  }
}

void SimParticipant::take_inbox() {
  if (const auto plan = inbox_->coverage.take()) {
    has_coverage_ = true;
    simulation_->see(*plan);
  }
  if (const auto charger = inbox_->charger.take()) {
    charger_activity_ = charger->activity;
    simulation_->see(*charger);
  }
  if (const auto plan = inbox_->path.take()) take_path(*plan);
}

std::string SimParticipant::missing_participants() const {
  std::string missing;
  const std::lock_guard lock(inbox_->mutex);
  for (const std::uint32_t id : options_.await) {
    const auto health = inbox_->health.find(id);
    const bool ready = health != inbox_->health.end() &&
                       (health->second == data::Health::kReady || health->second == data::Health::kDegraded);
    if (!ready) missing += (missing.empty() ? "participant " : ", ") + std::to_string(id);
  }
  return missing;
}

void SimParticipant::wait_for_others(double wall_s) {
  std::string missing = missing_participants();
  const bool has_plan = simulation_->mission().task ? has_coverage_ : has_path_;
  if (missing.empty() && has_plan) {
    state_ = data::ClockState::kRunning;
    pace_.start(wall_s);
    status_->set_health(data::Health::kReady, "simulates");
    return;
  }
  if (wall_s - opened_s_ < options_.await_limit_s) return;
  if (missing.empty()) missing = simulation_->mission().task ? "a coverage plan" : "a path plan";
  simulation_->end({.completed = false, .reason = "waited in vain for " + missing});
  state_ = data::ClockState::kEnded;
}

Status SimParticipant::run(double wall_s) {
  for (std::uint64_t owed = pace_.owed(wall_s); owed > 0 && !simulation_->outcome(); --owed) {
    const Motion before = simulation_->motion();
    const Changes changes = simulation_->step();
    if (Status sent = publish_changes(changes); !sent) return sent;
    const Motion& now = simulation_->motion();
    const bool turned = now.mode != before.mode || now.legs_done != before.legs_done;
    if ((turned || simulation_->steps() % kStepsPerVehicleState == 0) && vehicle_throttle_.allows(wall_s)) {
      vehicle_due_.put_off(wall_s);
      if (Status sent = publish_vehicle(); !sent) return sent;
    }
    if (simulation_->steps() % kStepsPerBatteryState == 0 && battery_throttle_.allows(wall_s)) {
      battery_due_.put_off(wall_s);
      if (Status sent = publish_battery(); !sent) return sent;
    }
  }
  if (simulation_->outcome()) {
    state_ = data::ClockState::kEnded;
    if (Status sent = publish_vehicle(); !sent) return sent;
    return publish_battery();
  }
  return {};
}

Surroundings SimParticipant::surroundings() const {
  return {.state = state_, .charger_activity = charger_activity_};
}

void SimParticipant::show_progress(double wall_s) {
  if (!options_.on_progress || !progress_due_(wall_s)) return;
  options_.on_progress(progress_line(*simulation_, surroundings()));
}

std::string SimParticipant::summary() const { return summary_line(*simulation_, surroundings()); }

void SimParticipant::interrupt() { interrupted_ = true; }

Result<bool> SimParticipant::step() {
  const double wall_s = clock_.now_s();
  if (interrupted_) {
    simulation_->end({.completed = false, .reason = "interrupted"});
    state_ = data::ClockState::kEnded;
  }
  take_inbox();
  if (state_ == data::ClockState::kWaiting) wait_for_others(wall_s);
  if (state_ == data::ClockState::kRunning) {
    if (Status done = run(wall_s); !done) return done.error();
  }
  if (state_ == data::ClockState::kEnded) {
    if (farewells_ == kFarewells) return false;
    if (clock_due_(wall_s)) {
      ++farewells_;
      const Status told =
          clocks_->publish({.time_s = simulation_->time_s(), .rate = options_.rate, .state = state_});
      if (!told) return told.error();
    }
  } else {
    if (Status sent = publish_due(wall_s); !sent) return sent.error();
    show_progress(wall_s);
  }
  if (Status sent = status_->step(); !sent) return sent.error();
  return true;
}

}  // namespace swallowtail::sim
