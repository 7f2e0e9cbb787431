#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "tools/sim/aircraft.hpp"
#include "tools/sim/battery.hpp"
#include "tools/sim/coverage_raster.hpp"
#include "tools/sim/referee.hpp"
#include "tools/sim/safety.hpp"
#include "tools/sim/samples.hpp"
#include "tools/sim/timeline.hpp"

namespace swallowtail::sim {

struct SimulationOptions {
  std::uint64_t seed = 1;
  double max_time_s = std::numeric_limits<double>::infinity();
  double grace_s = 5.0;         ///< see Referee
  double consumption = 1.0;     ///< see Battery
  double capacity_share = 1.0;  ///< what the battery holds in truth, of the scenario's capacity
};

/// The simulated world and aircraft, in fixed steps of mission time: terrain, obstacles and events, flight,
/// battery, what was seen, what came too near, and whether the mission is over. The same scenario, seed and
/// inputs at the same steps give the same world to the bit; wall time does not enter.
class Simulation {
 public:
  static constexpr double kStep_s = 0.05;

  static Result<std::unique_ptr<Simulation>> make(const planner::Scenario& scenario,
                                                  const SimulationOptions& options);

  Offer offer(const data::PathPlan& plan);
  void see(const data::CoveragePlan& plan);
  void see(const data::ChargerState& charger);

  /// One step. Returns what changed in the world; the obstacles' samples are published by whoever steps.
  Changes step();

  double time_s() const { return static_cast<double>(steps_) * kStep_s; }
  std::uint64_t steps() const { return steps_; }
  const std::optional<Outcome>& outcome() const { return outcome_; }
  void end(Outcome outcome);

  const planner::Scenario& scenario() const { return scenario_; }
  const Mission& mission() const { return mission_; }
  const planner::Terrain& terrain() const { return terrain_; }
  const Timeline& timeline() const { return timeline_; }
  const Motion& motion() const { return aircraft_.motion(); }
  /// None in a mission for a goal, where energy is no matter.
  const Battery* battery() const { return battery_ ? &*battery_ : nullptr; }
  const Safety& safety() const { return safety_; }
  double covered_percent() const { return raster_ ? raster_->covered_percent() : 0.0; }

  /// Figures of the mission so far.
  struct Tally {
    double flown_s = 0.0;
    std::uint32_t recharges = 0;
    std::uint32_t replans = 0;        ///< revisions of the PathPlan seen
    std::uint32_t contingencies = 0;  ///< of them
    std::uint32_t stale_starts = 0;
    std::optional<data::PathVerdict> verdict;  ///< of the newest
    PlanSummary plan;
  };
  const Tally& tally() const { return tally_; }

 private:
  Simulation(const planner::Scenario& scenario, const SimulationOptions& options, planner::Terrain terrain,
             Mission mission, Timeline timeline);

  void observe(const Motion& before);
  void replace_aircraft();

  const planner::Scenario scenario_;
  const planner::Terrain terrain_;
  const Mission mission_;
  Timeline timeline_;
  Aircraft aircraft_;
  std::optional<Battery> battery_;
  Safety safety_;
  std::optional<CoverageRaster> raster_;
  Referee referee_;
  Tally tally_;
  std::uint64_t steps_ = 0;
  std::optional<planner::AircraftReplaced> other_aircraft_;  ///< waits for the one that flies to land
  double aloft_s_ = 0.0;                                     ///< when it was last
  bool charged_here_ = false;                                ///< in this stay on the ground
  std::optional<Outcome> outcome_;
};

}  // namespace swallowtail::sim
