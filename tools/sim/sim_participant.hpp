#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "planner/base/clock.hpp"
#include "planner/base/mailbox.hpp"
#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "qos/bus.hpp"
#include "qos/participant/due.hpp"
#include "qos/participant/status.hpp"
#include "tools/sim/pace.hpp"
#include "tools/sim/progress.hpp"
#include "tools/sim/simulation.hpp"

namespace swallowtail::sim {

struct SimOptions {
  double rate = 1.0;                   ///< mission seconds per wall second
  std::vector<std::uint32_t> await{};  ///< participants that must be ready before the clock runs
  double await_limit_s = 120.0;        ///< wall time; then the mission fails
  double max_time_s = std::numeric_limits<double>::infinity();  ///< mission time
  std::uint64_t seed = 1;
  double consumption = 1.0;                               ///< see Battery
  double capacity_share = 1.0;                            ///< see SimulationOptions
  double progress_period_s = 0.5;                         ///< wall time
  std::function<void(const std::string&)> on_progress{};  ///< may be empty
};
/// Rate and limits positive.
Status validate(const SimOptions& options);

/// The simulated world and aircraft on the wire. It waits for whom it shall await and for a first plan, lets
/// the mission clock run at its rate, and ends the clock when the mission is over.
/// - written: TerrainTile, Obstacle, CoverageTask or Goal, VehicleState (0.1 s of mission time, at most 250
/// Hz), BatteryState (1 s, at most 20 Hz), MissionClock (20 Hz), ParticipantStatus;
/// - read: PathPlan, CoveragePlan, ChargerState, ParticipantStatus.
class SimParticipant {
 public:
  static Result<std::unique_ptr<SimParticipant>> make(Bus& bus, const Clock& clock,
                                                      const planner::Scenario& scenario, SimOptions options);

  /// Takes what has arrived, simulates up to the present and publishes what is due. Returns false once the
  /// end has been told to everyone.
  Result<bool> step();

  /// Ends the mission at the next step.
  void interrupt();

  const Simulation& simulation() const { return *simulation_; }
  data::ClockState state() const { return state_; }
  std::string summary() const;
  /// Mission seconds by which the simulation has fallen behind its rate, because the machine was too slow.
  double slipped_s() const { return pace_.slipped_s(); }

 private:
  /// What the bus's threads hand over. Shared with the handlers, which may run until the bus is gone.
  struct Inbox {
    Mailbox<data::PathPlan> path;
    Mailbox<data::CoveragePlan> coverage;
    Mailbox<data::ChargerState> charger;
    std::mutex mutex;
    std::map<std::uint32_t, data::Health> health;  ///< by participant id; guarded by mutex
  };

  SimParticipant(Bus& bus, const Clock& clock, SimOptions options, std::unique_ptr<Simulation> simulation);

  Status connect();
  Status subscribe();
  Status publish_world();
  Status publish_changes(const Changes& changes);
  Status publish_due(double wall_s);
  Status publish_vehicle();
  Status publish_battery();
  void take_inbox();
  void take_path(const data::PathPlan& plan);
  void wait_for_others(double wall_s);
  std::string missing_participants() const;
  Status run(double wall_s);
  void show_progress(double wall_s);
  Surroundings surroundings() const;

  Bus& bus_;
  const Clock& clock_;
  const SimOptions options_;
  std::unique_ptr<Simulation> simulation_;
  const std::shared_ptr<Inbox> inbox_ = std::make_shared<Inbox>();
  std::unique_ptr<StatusPublisher> status_;
  std::unique_ptr<Publisher<data::TerrainTile>> tiles_;
  std::unique_ptr<Publisher<data::Obstacle>> obstacles_;
  std::unique_ptr<Publisher<data::CoverageTask>> tasks_;
  std::unique_ptr<Publisher<data::Goal>> goals_;
  std::unique_ptr<Publisher<data::VehicleState>> vehicles_;
  std::unique_ptr<Publisher<data::BatteryState>> batteries_;
  std::unique_ptr<Publisher<data::MissionClock>> clocks_;

  data::ClockState state_ = data::ClockState::kWaiting;
  Pace pace_;
  Throttle vehicle_throttle_{1.0 / 250.0};
  Throttle battery_throttle_{1.0 / 20.0};
  Due clock_due_{1.0 / 20.0};
  Due vehicle_due_{0.25};  ///< however slow the mission runs, its readers' deadlines are kept
  Due battery_due_{1.0};
  Due progress_due_;
  double opened_s_ = 0.0;
  int farewells_ = 0;
  bool interrupted_ = false;
  bool has_path_ = false;
  bool has_coverage_ = false;
  data::ChargerActivity charger_activity_ = data::ChargerActivity::kIdle;
};

}  // namespace swallowtail::sim
