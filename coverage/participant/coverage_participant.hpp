#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "coverage/maintain/plan_keeper.hpp"
#include "coverage/participant/convert.hpp"
#include "coverage/participant/ground_map.hpp"
#include "idl/data/types.hpp"
#include "planner/base/clock.hpp"
#include "planner/base/mailbox.hpp"
#include "qos/bus.hpp"
#include "qos/participant/due.hpp"
#include "qos/participant/mission_time.hpp"
#include "qos/participant/status.hpp"

namespace swallowtail::coverage {

struct ParticipantOptions {
  gtsp::Mode mode = gtsp::Mode::kFast;
  double planning_s = 10.0;          ///< wall time for the first plan
  double reaction_wall_s = 0.4;      ///< from a change of plan until the aircraft flies it
  double liveliness_period_s = 0.1;  ///< wall time between two signs of life of the plans' writers
  std::uint32_t ownership_strength = 10;
  const std::atomic<bool>* stop_requested = nullptr;
};

/// Joins PlanKeeper to the wire: reads CoverageTask, TerrainTile, VehicleState, BatteryState,
/// ChargerState, PathPlan and MissionClock, writes CoveragePlan, ChargerPlan and ParticipantStatus. A new
/// revision of the task is planned afresh while the aircraft has not flown a leg; later ones may change the
/// fields only (see PlanKeeper::change_task) and are refused else, with the reason in the status. A plan
/// found on the wire for the task (of another coverage participant, gone or going) is taken up, not made
/// anew.
class CoverageParticipant {
 public:
  static Result<std::unique_ptr<CoverageParticipant>> make(Bus& bus, const Clock& clock,
                                                           ParticipantOptions options);

  /// Takes what has arrived, plans, publishes what is due. Call it every 20 ms or so; it returns late after a
  /// (re)plan.
  Status step();
  bool ended() const { return inbox_->time.ended(); }

 private:
  CoverageParticipant(Bus& bus, const Clock& clock, ParticipantOptions options);

  /// What the bus's threads hand over. Shared with the handlers, which may run until the bus is gone.
  struct Inbox {
    MissionTime time;
    Mailbox<data::CoverageTask> task;
    Mailbox<data::CoveragePlan> plan;  ///< of somebody else, before ours
    Mailbox<data::BatteryState> battery;
    Mailbox<data::ChargerState> charger;
    Mailbox<data::PathPlan> path;
    std::mutex mutex;
    std::deque<data::VehicleState> vehicle;  ///< every one: strips are judged by them
    std::vector<data::TerrainTile> tiles;
    std::atomic<std::uint32_t> vehicle_id{0};
    std::atomic<std::uint32_t> charger_id{0};
    std::atomic<double> capacity{0.0};
    std::atomic<std::uint32_t> own_revision{0};  ///< the newest we published; 0: none yet
  };

  Status connect();
  Status subscribe_world();
  Status subscribe_states();
  void take_tiles();
  void take_task();
  void change_task(data::CoverageTask task, Task wanted);
  void plan_when_ready();
  void resume_or_plan(const planner::Terrain& terrain);
  KeeperParams keeper_params() const;
  void plan(Task task, const planner::Terrain& terrain);
  bool fits_the_wire(const WirePlans& plans);
  void take_states();
  Status publish_plan();
  Status keep_alive();

  Bus& bus_;
  const Clock& clock_;
  const ParticipantOptions options_;
  const std::shared_ptr<Inbox> inbox_ = std::make_shared<Inbox>();
  std::unique_ptr<StatusPublisher> status_;
  std::unique_ptr<Publisher<data::CoveragePlan>> coverage_publisher_;
  std::unique_ptr<Publisher<data::ChargerPlan>> charger_publisher_;

  GroundMap ground_;
  std::optional<data::CoverageTask> task_;
  bool needs_plan_ = false;
  std::optional<data::VehicleState> last_vehicle_;
  std::optional<planner::Terrain> terrain_;  ///< that was planned over
  std::optional<Vec3> robot_m_;              ///< where it was last
  std::uint32_t path_revision_ = 0;          ///< of the newest that was taken up
  std::optional<PlanKeeper> keeper_;
  bool is_published_ = false;
  Due alive_;
};

}  // namespace swallowtail::coverage
