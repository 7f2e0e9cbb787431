#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <variant>
#include <vector>

#include "idl/data/types.hpp"
#include "planner/base/clock.hpp"
#include "planner/base/mailbox.hpp"
#include "planner/base/result.hpp"
#include "planner/participant/flight_log.hpp"
#include "planner/participant/goal_way.hpp"
#include "planner/participant/sortie.hpp"
#include "planner/participant/world_keeper.hpp"
#include "planner/replan/replanner.hpp"
#include "planner/world/prisms.hpp"
#include "qos/bus.hpp"
#include "qos/participant/mission_time.hpp"
#include "qos/participant/status.hpp"

namespace swallowtail::planner {

struct PlannerOptions {
  std::uint32_t vehicle_id = 1;
  double budget_ms = 60.0;               ///< wall time for the search of one replan
  std::int32_t ownership_strength = 10;  ///< below kActiveStrength it reports itself as the standby planner
  static constexpr std::int32_t kActiveStrength = 10;
  /// The most by which an obstacle that moves may turn or change its speed. From then until the aircraft
  /// flies what answers it (`lead_s`, of mission time) it gets ½ · acceleration · lead_s² away from where it
  /// was said to be: moving obstacles get so much margin more. 0: none, the margins that their publishers
  /// state must do. How late a sample tells of the turn is the publisher's to state in any case.
  double obstacle_acceleration_mps2 = 0.0;
};
Status validate(const PlannerOptions& options);

/// Keeps one vehicle's path true. Reads TerrainTile, Obstacle, VehicleState, CoverageTask, CoveragePlan,
/// ChargerPlan, Goal, ChargerState, MissionClock and the PathPlan of whoever else plans for this vehicle;
/// writes PathPlan and ParticipantStatus.
/// - On the ground and free to go (at the mission's start, unless the charger is to come there first; or
/// charged, the charger READY beside it) it plans the next sortie along the legs ahead, or the way to the
/// goal.
/// - In flight it certifies the rest of the path anew whenever the world changes, and replans from where the
/// vehicle will be in `lead_s` if that fails or the legs ahead have changed; a contingency is replaced as
/// soon as something better is certified. What turns takes up the margin that was kept from it for that:
/// where nothing is certified with that margin any more, a path without it is a contingency.
/// - What is published has been certified as a whole; where nothing can be, nothing is published and the
/// status says so. `step` does the work on the caller's thread; `beat` keeps liveliness and status going and
/// may be called from another thread meanwhile.
class PlannerParticipant {
 public:
  static Result<std::unique_ptr<PlannerParticipant>> make(Bus& bus, const Clock& clock,
                                                          PlannerOptions options);

  Status step();
  /// Asserts liveliness while `step` is alive (returned within kStuck_s), and publishes the status when due.
  Status beat();

  static constexpr double kStuck_s = 2.0;
  /// Wall time between two tries to better a contingency, or to find any path after there was none.
  static constexpr double kRetryWall_s = 0.5;
  /// Mission seconds between the decision to replan and the start of the new path, at a rate.
  static double lead_s(double rate, double budget_ms);

 private:
  struct Gone {
    std::uint32_t obstacle_id = 0;
  };
  using Change = std::variant<data::TerrainTile, data::Obstacle, Gone>;

  /// What the bus's threads hand over. Shared with the handlers, which may run until the bus is gone.
  struct Inbox {
    MissionTime time;
    Mailbox<data::VehicleState> vehicle;
    Mailbox<data::CoverageTask> task;
    Mailbox<data::CoveragePlan> coverage;
    Mailbox<data::Goal> goal;
    Mailbox<data::ChargerState> charger;
    Mailbox<data::ChargerPlan> orders;
    std::atomic<std::uint32_t> charger_id{0};  ///< of the task; 0: not known yet
    Mailbox<data::PathPlan> path;
    std::mutex mutex;
    std::vector<Change> changes;  ///< guarded by mutex, in order
    double changed_wall_s = 0.0;  ///< of the first change not yet taken; guarded by mutex
    void put(Change change, double wall_s);
    void note_change(double wall_s);
    std::vector<Change> take(double& changed_wall_s);
  };

  PlannerParticipant(Bus& bus, const Clock& clock, PlannerOptions options);

  Status connect();
  Status subscribe();
  Status subscribe_world();
  Status subscribe_mission();
  void take_inbox();
  void take_changes();
  void take_mission();
  void take_task(const data::CoverageTask& task);
  void take_path();
  void use_limits(const data::VehicleLimits& limits, std::uint64_t seed);

  bool has_mission() const;
  bool meets_charger_first() const;
  bool may_take_off() const;
  bool lost_track() const;
  Status act(double now_s);
  Status act_on_ground(double now_s, bool changed);
  Status act_in_flight(double now_s, bool changed);
  RouteStart start_of_route(double join_s) const;
  std::vector<RoutePoint> route_from(const RouteStart& start, double join_s);
  std::vector<RoutePoint> route_to_goal(const RouteStart& start, double join_s);
  Status plan_from_ground(double now_s);
  Status replan(double now_s);
  std::optional<ReplanReport> plan_from_air(double now_s, double lead,
                                            const std::shared_ptr<const World>& world);
  ReplanReport plan_or_land(ReplanRequest request, const std::shared_ptr<const World>& world);
  ReplanReport land_near(ReplanRequest request, ReplanReport found,
                         const std::shared_ptr<const World>& world);
  StopCondition search_limit() const;
  double spare_s(std::uint32_t leg) const;
  Status publish(const ReplanReport& report, double now_s, double replan_ms);
  void fail(const ReplanReport& report);

  Bus& bus_;
  const Clock& clock_;
  const PlannerOptions options_;
  const std::shared_ptr<Inbox> inbox_ = std::make_shared<Inbox>();
  std::unique_ptr<StatusPublisher> status_;
  std::unique_ptr<Publisher<data::PathPlan>> publisher_;
  std::atomic<double> last_step_wall_s_{0.0};

  WorldKeeper keeper_;
  VehicleLimits limits_;
  std::optional<Replanner> replanner_;
  std::optional<data::CoverageTask> task_;
  std::vector<Area> no_drive_;  ///< of the task
  std::optional<data::CoveragePlan> coverage_;
  std::optional<data::Goal> goal_;
  std::optional<data::ChargerState> charger_;
  std::optional<data::ChargerPlan> orders_;
  std::optional<data::VehicleState> vehicle_;
  bool mission_changed_ = false;
  bool owes_path_ = false;  ///< there was no safe path for what has changed since the last one

  FlightLog log_;
  Sortie sortie_;
  GoalWay way_;
  Verdict verdict_ = Verdict::kCertified;  ///< of the newest path
  std::optional<data::PathPlan> published_;
  std::uint32_t revision_ = 0;  ///< greatest seen or published
  double published_wall_s_ = 0.0;
  double retry_wall_s_ = 0.0;
  double changed_wall_s_ = 0.0;  ///< when what is being reacted to arrived; 0: nothing
  double last_now_s_ = 0.0;
  int late_ = 0;  ///< replans in a row that took longer than the lead
};

}  // namespace swallowtail::planner
