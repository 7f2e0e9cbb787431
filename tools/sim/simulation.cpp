#include "tools/sim/simulation.hpp"

#include <utility>

#include "planner/scenario/load.hpp"
#include "tools/sim/convert.hpp"

namespace swallowtail::sim {
namespace {

/// That an aircraft stands before another takes its place.
constexpr double kSwap_s = 5.0;

}  // namespace

Result<std::unique_ptr<Simulation>> Simulation::make(const planner::Scenario& scenario,
                                                     const SimulationOptions& options) {
  auto terrain = planner::load_terrain(scenario);
  if (!terrain) return terrain.error();
  auto mission = make_mission(scenario, *terrain, options.seed);
  if (!mission) return mission.error();
  auto timeline = Timeline::make(scenario, *terrain);
  if (!timeline) return timeline.error();
  return std::unique_ptr<Simulation>(new Simulation(scenario, options, std::move(terrain).value(),
                                                    std::move(mission).value(), std::move(timeline).value()));
}

Simulation::Simulation(const planner::Scenario& scenario, const SimulationOptions& options,
                       planner::Terrain terrain, Mission mission, Timeline timeline)
    : scenario_(scenario),
      terrain_(std::move(terrain)),
      mission_(std::move(mission)),
      timeline_(std::move(timeline)),
      aircraft_(scenario.vehicle.id, mission_.start_m, terrain_),
      safety_(scenario.vehicle.limits, timeline_.world(), mission_.no_fly),
      referee_({.goal_m = scenario.coverage ? std::nullopt : scenario.goal_m,
                .max_time_s = options.max_time_s,
                .grace_s = options.grace_s}) {
  if (scenario_.coverage) {
    const planner::CoverageSpec& coverage = *scenario_.coverage;
    battery_.emplace(scenario_, options.capacity_share * coverage.battery.capacity, options.seed,
                     options.consumption);
    const bool skips = coverage.headland == planner::HeadlandUse::kSkip;
    raster_.emplace(mission_.fields, terrain_,
                    SwathParams{.sensor_width_m = coverage.sensor_width_m,
                                .height_tolerance_m = coverage.height_tolerance_m,
                                .no_fly = mission_.no_fly,
                                .skipped_border_m = skips ? coverage.headland_m : 0.0});
  }
}

Offer Simulation::offer(const data::PathPlan& plan) {
  const Offer answer = aircraft_.offer(plan);
  if (answer == Offer::kKnown) return answer;
  ++tally_.replans;
  tally_.verdict = plan.verdict;
  if (plan.verdict == data::PathVerdict::kContingency) ++tally_.contingencies;
  if (answer == Offer::kStaleStart) ++tally_.stale_starts;
  referee_.see_verdict(plan.verdict, time_s());
  return answer;
}

void Simulation::see(const data::CoveragePlan& plan) {
  aircraft_.learn_legs(plan);
  tally_.plan = {.revision = plan.revision,
                 .legs_total = static_cast<std::uint32_t>(plan.legs.size()),
                 .complete = plan.complete,
                 .reason = plan.reason};
  referee_.see_plan(tally_.plan);
}

void Simulation::see(const data::ChargerState& charger) { aircraft_.see_charger(charger); }

Changes Simulation::step() {
  if (outcome_) return {};
  const Motion before = aircraft_.motion();
  ++steps_;
  Changes changes = timeline_.advance(time_s());
  if (changes.world_changed()) safety_.change_world(timeline_.world());
  aircraft_.advance(time_s());
  observe(before);
  if (battery_ && changes.energy_lost > 0.0) battery_->lose(changes.energy_lost);
  if (changes.aircraft) other_aircraft_ = changes.aircraft;
  if (!aircraft_.motion().on_ground()) aloft_s_ = time_s();
  if (other_aircraft_ && time_s() >= aloft_s_ + kSwap_s) replace_aircraft();
  const double energy = battery_ ? battery_->energy() : 1.0;
  outcome_ = referee_.judge(aircraft_.motion(), energy);
  return changes;
}

/// Where all is flown already, nothing is left to take over.
void Simulation::replace_aircraft() {
  const planner::AircraftReplaced other = *std::exchange(other_aircraft_, std::nullopt);
  const PlanSummary& plan = tally_.plan;
  if (plan.legs_total > 0 && aircraft_.motion().legs_done >= plan.legs_total) return;
  Vec3 start_m = mission_.start_m;
  if (other.start_m)
    start_m = {other.start_m->x(), other.start_m->y(),
               terrain_.height_at(other.start_m->x(), other.start_m->y())};
  aircraft_.replace(start_m);
  const double capacity = other.capacity.value_or(scenario_.coverage->battery.capacity);
  battery_->replace(capacity, other.energy.value_or(capacity));
  charged_here_ = false;
}

void Simulation::observe(const Motion& before) {
  const Motion& now = aircraft_.motion();
  Motion from = before;
  for (const Motion& corner : aircraft_.corners()) {
    safety_.observe(from, corner);
    from = corner;
  }
  safety_.observe(from, now);
  if (!now.on_ground()) {
    tally_.flown_s += kStep_s;
    charged_here_ = false;
  }
  if (battery_) {
    const double charge_rate = aircraft_.charge_rate();
    battery_->advance({.on_ground = now.on_ground(),
                       .velocity_mps = now.velocity_mps,
                       .charge_rate = charge_rate,
                       .altitude_m = now.position_m.z()},
                      kStep_s);
    if (charge_rate > 0.0 && !charged_here_) {
      charged_here_ = true;
      ++tally_.recharges;
    }
  }
  if (raster_) {
    for (const Stretch& stretch : aircraft_.covered()) raster_->stamp(stretch.from_m, stretch.to_m);
  }
}

void Simulation::end(Outcome outcome) {
  if (!outcome_) outcome_ = std::move(outcome);
}

}  // namespace swallowtail::sim
