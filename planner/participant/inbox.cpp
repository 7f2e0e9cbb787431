#include "planner/participant/planner_participant.hpp"

#include <utility>

namespace swallowtail::planner {

void PlannerParticipant::Inbox::note_change(double wall_s) {
  const std::lock_guard lock(mutex);
  if (changed_wall_s == 0.0) changed_wall_s = wall_s;
}

void PlannerParticipant::Inbox::put(Change change, double wall_s) {
  const std::lock_guard lock(mutex);
  if (changed_wall_s == 0.0) changed_wall_s = wall_s;
  changes.push_back(std::move(change));
}

std::vector<PlannerParticipant::Change> PlannerParticipant::Inbox::take(double& arrived_wall_s) {
  const std::lock_guard lock(mutex);
  arrived_wall_s = std::exchange(changed_wall_s, 0.0);
  return std::exchange(changes, {});
}

void PlannerParticipant::take_changes() {
  double arrived_wall_s = 0.0;
  for (const Change& change : inbox_->take(arrived_wall_s)) {
    if (const auto* gone = std::get_if<Gone>(&change)) keeper_.remove_obstacle(gone->obstacle_id);
    if (const auto* tile = std::get_if<data::TerrainTile>(&change)) {
      if (!keeper_.put(*tile)) bus_.count_rejection("TerrainTile", "does not fit its map");
    }
    if (const auto* obstacle = std::get_if<data::Obstacle>(&change)) {
      if (!keeper_.put(*obstacle)) bus_.count_rejection("Obstacle", "unusable shape");
    }
  }
  if (arrived_wall_s > 0.0 && changed_wall_s_ == 0.0) changed_wall_s_ = arrived_wall_s;
}

Status PlannerParticipant::connect() {
  const bool active = options_.ownership_strength >= PlannerOptions::kActiveStrength;
  auto status = StatusPublisher::make(bus_, clock_,
                                      {.participant_id = active ? data::kPlannerId : data::kStandbyPlannerId,
                                       .name = active ? "planner" : "planner-standby"});
  if (!status) return status.error();
  status_ = std::move(status).value();
  auto publisher = bus_.publisher<data::PathPlan>({.ownership_strength = options_.ownership_strength});
  if (!publisher) return publisher.error();
  publisher_ = std::move(publisher).value();
  if (Status subscribed = subscribe(); !subscribed) return subscribed;
  status_->set_health(data::Health::kReady, "waits for a mission");
  return {};
}

Status PlannerParticipant::subscribe() {
  if (Status done = subscribe_world(); !done) return done;
  return subscribe_mission();
}

Status PlannerParticipant::subscribe_world() {
  const Clock* wall = &clock_;
  const auto inbox = inbox_;
  Status done =
      bus_.subscribe<data::MissionClock>({.on_sample = [inbox, wall](const data::MissionClock& clock) {
        inbox->time.update(clock, wall->now_s());
      }});
  if (!done) return done;
  done = bus_.subscribe<data::TerrainTile>(
      {.on_sample = [inbox, wall](const data::TerrainTile& tile) { inbox->put(tile, wall->now_s()); }});
  if (!done) return done;
  return bus_.subscribe<data::Obstacle>(
      {.on_sample = [inbox, wall](const data::Obstacle& obstacle) { inbox->put(obstacle, wall->now_s()); },
       .on_gone = [inbox, wall](const InstanceKey& key) { inbox->put(Gone{key[0]}, wall->now_s()); }});
}

Status PlannerParticipant::subscribe_mission() {
  Bus* bus = &bus_;
  const Clock* wall = &clock_;
  const auto inbox = inbox_;
  const std::uint32_t ours = options_.vehicle_id;
  Status done =
      bus_.subscribe<data::VehicleState>({.on_sample = [inbox, bus, ours](const data::VehicleState& v) {
        if (v.vehicle_id != ours) return bus->count_rejection("VehicleState", "unknown vehicle");
        inbox->vehicle.put(v);
      }});
  if (!done) return done;
  done = bus_.subscribe<data::CoverageTask>(
      {.on_sample = [inbox, bus, ours, wall](const data::CoverageTask& task) {
        if (task.vehicle_id != ours) return bus->count_rejection("CoverageTask", "unknown vehicle");
        inbox->task.put(task);
        inbox->note_change(wall->now_s());
      }});
  if (!done) return done;
  done = bus_.subscribe<data::CoveragePlan>(
      {.on_sample = [inbox, bus, ours, wall](const data::CoveragePlan& plan) {
        if (plan.vehicle_id != ours) return bus->count_rejection("CoveragePlan", "unknown vehicle");
        inbox->coverage.put(plan);
        inbox->note_change(wall->now_s());
      }});
  if (!done) return done;
  done = bus_.subscribe<data::Goal>({.on_sample = [inbox, bus, ours, wall](const data::Goal& goal) {
    if (goal.vehicle_id != ours) return bus->count_rejection("Goal", "unknown vehicle");
    inbox->goal.put(goal);
    inbox->note_change(wall->now_s());
  }});
  if (!done) return done;
  done = bus_.subscribe<data::ChargerState>({.on_sample = [inbox, bus](const data::ChargerState& charger) {
    const std::uint32_t known = inbox->charger_id.load();
    if (known != 0 && charger.charger_id != known)
      return bus->count_rejection("ChargerState", "unknown charger");
    inbox->charger.put(charger);
  }});
  if (!done) return done;
  done = bus_.subscribe<data::ChargerPlan>({.on_sample = [inbox, bus, ours](const data::ChargerPlan& orders) {
    if (orders.vehicle_id != ours) return bus->count_rejection("ChargerPlan", "unknown vehicle");
    inbox->orders.put(orders);
  }});
  if (!done) return done;
  return bus_.subscribe<data::PathPlan>({.on_sample = [inbox, ours](const data::PathPlan& plan) {
    if (plan.vehicle_id == ours) inbox->path.put(plan);
  }});
}

}  // namespace swallowtail::planner
