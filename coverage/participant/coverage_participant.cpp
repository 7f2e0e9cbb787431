#include "coverage/participant/coverage_participant.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "coverage/participant/convert.hpp"
#include "coverage/participant/task_of.hpp"

namespace swallowtail::coverage {
namespace {

constexpr std::size_t kMaxWaitingStates = 4096;
constexpr std::size_t kMaxWaitingTiles = 8192;
constexpr double kCapacityTolerance = 1e-6;

}  // namespace

Result<std::unique_ptr<CoverageParticipant>> CoverageParticipant::make(Bus& bus, const Clock& clock,
                                                                       ParticipantOptions options) {
  std::unique_ptr<CoverageParticipant> coverage(new CoverageParticipant(bus, clock, options));
  if (Status status = coverage->connect(); !status) return status.error();
  return coverage;
}

CoverageParticipant::CoverageParticipant(Bus& bus, const Clock& clock, ParticipantOptions options)
    : bus_(bus), clock_(clock), options_(options), alive_(options.liveliness_period_s) {}

Status CoverageParticipant::connect() {
  auto status =
      StatusPublisher::make(bus_, clock_, {.participant_id = data::kCoverageId, .name = "coverage"});
  if (!status) return status.error();
  status_ = std::move(status).value();
  const PublisherOptions strength{.ownership_strength =
                                      static_cast<std::int32_t>(options_.ownership_strength)};
  auto coverage = bus_.publisher<data::CoveragePlan>(strength);
  if (!coverage) return coverage.error();
  coverage_publisher_ = std::move(coverage).value();
  auto charger = bus_.publisher<data::ChargerPlan>(strength);
  if (!charger) return charger.error();
  charger_publisher_ = std::move(charger).value();
  if (Status done = subscribe_world(); !done) return done;
  if (Status done = subscribe_states(); !done) return done;
  status_->set_health(data::Health::kReady, "waits for a task");
  return {};
}

Status CoverageParticipant::subscribe_world() {
  const auto inbox = inbox_;
  const Clock* wall = &clock_;
  Status done = bus_.subscribe<data::MissionClock>(
      {.on_sample = [inbox, wall](const data::MissionClock& c) { inbox->time.update(c, wall->now_s()); }});
  if (!done) return done;
  done = bus_.subscribe<data::TerrainTile>({.on_sample = [inbox](const data::TerrainTile& tile) {
    const std::lock_guard lock(inbox->mutex);
    if (inbox->tiles.size() < kMaxWaitingTiles) inbox->tiles.push_back(tile);
  }});
  if (!done) return done;
  done = bus_.subscribe<data::CoverageTask>(
      {.on_sample = [inbox](const data::CoverageTask& task) { inbox->task.put(task); }});
  if (!done) return done;
  return bus_.subscribe<data::CoveragePlan>({.on_sample = [inbox](const data::CoveragePlan& plan) {
    if (inbox->own_revision.load() == 0) inbox->plan.put(plan);
  }});
}

Status CoverageParticipant::subscribe_states() {
  const auto inbox = inbox_;
  Bus* bus = &bus_;
  Status done =
      bus_.subscribe<data::VehicleState>({.on_sample = [inbox, bus](const data::VehicleState& state) {
        const std::uint32_t ours = inbox->vehicle_id.load();
        if (ours != 0 && state.vehicle_id != ours)
          return bus->count_rejection("VehicleState", "unknown vehicle");
        const std::lock_guard lock(inbox->mutex);
        if (inbox->vehicle.size() >= kMaxWaitingStates) inbox->vehicle.pop_front();
        inbox->vehicle.push_back(state);
      }});
  if (!done) return done;
  done = bus_.subscribe<data::BatteryState>({.on_sample = [inbox, bus](const data::BatteryState& state) {
    const std::uint32_t ours = inbox->vehicle_id.load();
    if (ours != 0 && state.vehicle_id != ours) return bus->count_rejection("BatteryState", "unknown vehicle");
    const double capacity = inbox->capacity.load();
    if (ours != 0 && state.energy > capacity * (1.0 + kCapacityTolerance))
      return bus->count_rejection("BatteryState", "energy above the task's capacity");
    inbox->battery.put(state);
  }});
  if (!done) return done;
  done = bus_.subscribe<data::PathPlan>({.on_sample = [inbox](const data::PathPlan& plan) {
    if (plan.vehicle_id == inbox->vehicle_id.load() && !plan.waypoints.empty()) inbox->path.put(plan);
  }});
  if (!done) return done;
  return bus_.subscribe<data::ChargerState>({.on_sample = [inbox, bus](const data::ChargerState& state) {
    const std::uint32_t ours = inbox->charger_id.load();
    if (ours != 0 && state.charger_id != ours) return bus->count_rejection("ChargerState", "unknown charger");
    inbox->charger.put(state);
  }});
}

void CoverageParticipant::take_tiles() {
  std::vector<data::TerrainTile> tiles;
  {
    const std::lock_guard lock(inbox_->mutex);
    tiles.swap(inbox_->tiles);
  }
  for (const data::TerrainTile& tile : tiles) {
    if (!ground_.put(tile)) bus_.count_rejection("TerrainTile", "does not fit its map");
  }
}

void CoverageParticipant::take_task() {
  auto task = inbox_->task.take();
  if (!task) return;
  if (task_ && task->task_id == task_->task_id && task->revision <= task_->revision) return;
  const Result<Task> wanted = task_of(*task);
  if (!wanted) {
    bus_.count_rejection("CoverageTask", "field polygon not valid");
    status_->set_health(task_ ? data::Health::kReady : data::Health::kDegraded, wanted.error().message);
    return;
  }
  if (const Status good = validate(*wanted); !good) {
    bus_.count_rejection("CoverageTask", "limits out of range");
    status_->set_health(task_ ? data::Health::kReady : data::Health::kDegraded, good.error().message);
    return;
  }
  if (keeper_ && keeper_->has_begun()) return change_task(std::move(*task), *wanted);
  task_ = std::move(*task);
  needs_plan_ = true;
  inbox_->vehicle_id.store(task_->vehicle_id);
  inbox_->charger_id.store(task_->charger.charger_id);
  inbox_->capacity.store(task_->battery.capacity);
}

void CoverageParticipant::change_task(data::CoverageTask task, Task wanted) {
  if (task.task_id != task_->task_id || task.has_terrain != task_->has_terrain) {
    status_->set_health(data::Health::kReady,
                        "task " + std::to_string(task.task_id) + " is refused: a mission is under way");
    return bus_.count_rejection("CoverageTask", "a mission is under way");
  }
  const auto travel = travel_of(task, *terrain_);
  if (travel) wanted.charger.travel = *travel;
  const Status changed = travel ? keeper_->change_task(std::move(wanted)) : Status(travel.error());
  if (!changed) {
    status_->set_health(data::Health::kReady, "task revision " + std::to_string(task.revision) +
                                                  " is refused: " + changed.error().message);
    return bus_.count_rejection("CoverageTask", "the mission under way cannot take it up");
  }
  task_ = std::move(task);
  is_published_ = false;
  status_->count_replan();
  status_->set_health(data::Health::kReady,
                      "revision " + std::to_string(keeper_->plan().revision) + ": " + keeper_->plan().reason);
}

void CoverageParticipant::plan_when_ready() {
  if (!task_ || !needs_plan_) return;
  if (!task_->has_terrain) {
    // The ground is at the frame's origin elevation, which is z = 0.
    return resume_or_plan(planner::Terrain::flat(0.0));
  }
  if (!ground_.complete()) {
    status_->set_health(data::Health::kStarting, "waits for terrain");
    return;
  }
  Result<planner::Terrain> terrain = ground_.terrain();
  if (!terrain) {
    needs_plan_ = false;
    bus_.count_rejection("TerrainTile", "terrain out of range");
    return status_->set_health(data::Health::kDegraded, terrain.error().message);
  }
  resume_or_plan(*terrain);
}

void CoverageParticipant::resume_or_plan(const planner::Terrain& terrain) {
  needs_plan_ = false;
  terrain_ = terrain;
  Result<Task> task = task_of(*task_);
  const auto travel = travel_of(*task_, terrain);
  if (!task || !travel) {
    bus_.count_rejection("CoverageTask", "no plan for the task");
    return status_->set_health(data::Health::kDegraded, (task ? travel.error() : task.error()).message);
  }
  task->charger.travel = *travel;
  const auto found = inbox_->plan.take();
  const bool is_ours = found && found->task_id == task_->task_id && found->vehicle_id == task_->vehicle_id &&
                       found->basis.task_revision == task_->revision;
  if (is_ours && !keeper_) {
    keeper_.emplace(*task, terrain, keeper_params(), from_wire(*found, *task, terrain));
    status_->set_health(data::Health::kReady,
                        "goes on with plan revision " + std::to_string(found->revision));
    is_published_ = false;
  } else {
    plan(std::move(*task), terrain);
  }
}

KeeperParams CoverageParticipant::keeper_params() const {
  KeeperParams params;
  params.planning.seed = task_->seed;
  params.planning.mode = options_.mode;
  params.planning.clock = &clock_;
  params.planning.stop = {.clock = &clock_,
                          .deadline_s = clock_.now_s() + options_.planning_s,
                          .stop_requested = options_.stop_requested};
  return params;
}

void CoverageParticipant::plan(Task task, const planner::Terrain& terrain) {
  const double began_s = clock_.now_s();
  const std::uint32_t last_revision = keeper_ ? keeper_->plan().revision : 0;
  Result<PlanKeeper> made = PlanKeeper::make(std::move(task), terrain, keeper_params());
  if (!made) {
    bus_.count_rejection("CoverageTask", "no plan for the task");
    return status_->set_health(data::Health::kDegraded, made.error().message);
  }
  keeper_.emplace(std::move(*made));
  keeper_->set_revision_above(std::max(last_revision, last_vehicle_ ? last_vehicle_->coverage_revision : 0));
  if (last_vehicle_ && last_vehicle_->legs_done > 0) keeper_->start_over_after(to_view(*last_vehicle_));
  status_->add_latency_ms((clock_.now_s() - began_s) * 1e3);
  status_->set_health(data::Health::kReady, "plan revision " + std::to_string(keeper_->plan().revision));
  is_published_ = false;
}

void CoverageParticipant::take_states() {
  std::deque<data::VehicleState> states;
  {
    const std::lock_guard lock(inbox_->mutex);
    states.swap(inbox_->vehicle);
  }
  if (!states.empty()) last_vehicle_ = states.back();
  const auto battery = inbox_->battery.take();
  const auto charger = inbox_->charger.take();
  const auto path = inbox_->path.take();
  if (!keeper_ || ended()) return;
  keeper_->set_reaction(std::max(1.0, inbox_->time.rate() * options_.reaction_wall_s));
  const double began_s = clock_.now_s();
  bool changed = false;
  if (path && path->revision != path_revision_) {
    path_revision_ = path->revision;
    keeper_->on_path(to_view(*path));
  }
  if (charger && charger->charger_id == task_->charger.charger_id) {
    robot_m_ = to_view(*charger).position_m;
    changed |= keeper_->on_robot(to_view(*charger));
  }
  for (const data::VehicleState& state : states) {
    if (state.vehicle_id == task_->vehicle_id) changed |= keeper_->on_vehicle(to_view(state));
  }
  if (battery && battery->vehicle_id == task_->vehicle_id) changed |= keeper_->on_battery(to_view(*battery));
  if (!changed) return;
  is_published_ = false;
  status_->count_replan();
  status_->add_latency_ms((clock_.now_s() - began_s) * 1e3);
  status_->set_health(data::Health::kReady,
                      "revision " + std::to_string(keeper_->plan().revision) + ": " + keeper_->plan().reason);
}

bool CoverageParticipant::fits_the_wire(const WirePlans& plans) {
  const std::size_t legs = plans.coverage.legs.size();
  const std::size_t bends = std::max(plans.coverage.bends.size(), plans.charger.bends.size());
  const std::size_t stops = plans.charger.rendezvous.size();
  if (legs <= data::kMaxLegs && bends <= data::kMaxBends && stops <= data::kMaxRendezvous) return true;
  bus_.count_rejection("CoverageTask", "more than a plan holds");
  status_->set_health(data::Health::kDegraded,
                      "The plan has " + std::to_string(legs) + " legs, " + std::to_string(stops) +
                          " stops of the robot and ways with " + std::to_string(bends) +
                          " bends; a plan on the wire holds " + std::to_string(data::kMaxLegs) + ", " +
                          std::to_string(data::kMaxRendezvous) + " and " + std::to_string(data::kMaxBends) +
                          ". Split the task.");
  return false;
}

Status CoverageParticipant::publish_plan() {
  if (!keeper_ || is_published_) return {};
  const WirePlans plans =
      to_wire(*keeper_, *terrain_, robot_m_.value_or(keeper_->task().charger.start_m), ground_.revision());
  is_published_ = true;
  if (!fits_the_wire(plans)) return {};
  inbox_->own_revision.store(plans.coverage.revision);
  // The robot's first: it may learn where to go before the aircraft flies there, not after.
  if (Status sent = charger_publisher_->publish(plans.charger); !sent) return sent;
  if (Status sent = coverage_publisher_->publish(plans.coverage); !sent) return sent;
  alive_.put_off(clock_.now_s());
  return {};
}

Status CoverageParticipant::keep_alive() {
  if (!keeper_ || !alive_(clock_.now_s())) return {};
  coverage_publisher_->assert_liveliness();
  charger_publisher_->assert_liveliness();
  return {};
}

Status CoverageParticipant::step() {
  take_tiles();
  take_task();
  take_states();
  plan_when_ready();
  if (Status sent = publish_plan(); !sent) return sent;
  if (Status alive = keep_alive(); !alive) return alive;
  return status_->step();
}

}  // namespace swallowtail::coverage
