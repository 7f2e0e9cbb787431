#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coverage/energy/consumption.hpp"
#include "coverage/maintain/live_plan.hpp"
#include "coverage/maintain/path_ahead.hpp"
#include "coverage/maintain/rest.hpp"
#include "coverage/maintain/strip_track.hpp"
#include "coverage/schedule/robot_trips.hpp"

namespace swallowtail::coverage {

enum class AircraftMode : std::uint8_t { kLanded, kDocked, kTakingOff, kFlying, kLanding };

struct AircraftView {
  double time_s = 0.0;
  Vec3 position_m = Vec3::Zero();
  Vec3 velocity_mps = Vec3::Zero();
  AircraftMode mode = AircraftMode::kLanded;
  std::size_t leg_index = 0;
  std::size_t legs_done = 0;
  bool covering = true;  ///< looks down, wherever it is
  bool on_ground() const { return mode == AircraftMode::kLanded || mode == AircraftMode::kDocked; }
};

struct BatteryView {
  double time_s = 0.0;
  double energy = 0.0;
  double capacity = 0.0;  ///< what it holds when full, where it says so; 0: as the task says
};

struct RobotView {
  double time_s = 0.0;
  Vec3 position_m = Vec3::Zero();
  bool has_vehicle = false;
  bool is_delayed = false;
  bool is_ready = false;  ///< lets the aircraft on board go
  double energy = 0.0;    ///< its own; of no matter where the task does not limit it
};

struct KeeperParams {
  PlanOptions planning;
  /// A landing is in danger when the energy left does not do for so much more than predicted.
  double trigger_margin = 0.03;
  /// Mission seconds that a change needs to reach the aircraft: what it flies until then cannot be changed.
  /// Grows with the mission's rate (see set_reaction).
  double reaction_s = 1.0;
  double time_tolerance_s = 15.0;  ///< times are published anew only when they are off by more
  int gap_tries = 4;               ///< how often a stretch left out is tried again
  double resolve_deadline_s =
      0.2;  ///< wall time of the local search, on planning.clock; without a clock only its count limits it
  std::uint64_t resolve_schedules = 400;
};

/// Keeps a coverage plan true while it is flown: what is flown stays as a fixed prefix, the rest is scheduled
/// anew when the energy no longer reaches the next landing, when the aircraft lands where it was not meant
/// to, when a stretch was left out, or (times only) when aircraft or robot are late. A robot with a battery
/// of its own gets its trips to the depot with every revision, from where it is and what it holds, and a new
/// revision when what it holds does not last. Knows no middleware and no wall clock of its own.
class PlanKeeper {
 public:
  /// Plans the task. Errors: see plan_coverage.
  static Result<PlanKeeper> make(Task task, planner::Terrain terrain, KeeperParams params);

  /// Goes on with a plan made before. Cuts the task's fields once more, to know what transfers go round.
  PlanKeeper(Task task, planner::Terrain terrain, const KeeperParams& params, LivePlan plan);

  /// Each takes news and tells whether the plan was changed: plan() then has a new revision and a reason. A
  /// state that is not finite, or older than the newest, is refused and changes nothing.
  bool on_vehicle(const AircraftView& vehicle);
  bool on_battery(const BatteryView& battery);
  bool on_robot(const RobotView& robot);
  /// The path that the planner made of the plan: what it waits for and goes round takes energy too, which the
  /// next battery state is judged by.
  void on_path(const PathView& path);
  /// Other fields while the mission is under way: what is flown stays, the new fields are cut, what has been
  /// seen of them is left out and the rest is scheduled anew in an order of its own. Errors leave the plan as
  /// it is: (kBadInput) the task, or another aircraft or robot; (kInfeasible) no field can be planned, or the
  /// rest cannot be flown from here.
  Status change_task(Task task);
  /// For a plan made when others were in force before: its revision is above theirs.
  void set_revision_above(std::uint32_t revision) { plan_.revision = std::max(plan_.revision, revision + 1); }
  /// Whether anything has been flown, by this aircraft or one before it.
  bool has_begun() const { return plan_.legs_done > 0 || !retired_.empty(); }
  /// For a keeper that started in the middle of a mission without the plan that was flown: the unknown flown
  /// legs stand in the prefix as points, and everything is flown again.
  void start_over_after(const AircraftView& vehicle);
  void set_reaction(double reaction_s) { params_.reaction_s = reaction_s; }

  const LivePlan& plan() const { return plan_; }
  const Task& task() const { return task_; }
  const std::vector<FieldReport>& fields() const { return fields_; }
  /// Predicted energy at the next landing, from the newest state; nothing on the ground.
  std::optional<double> energy_at_next_landing() const;
  /// Landed this near to a meeting's place the aircraft is there: the robot takes it on board from where it
  /// waits. From farther away the robot is asked to come.
  static constexpr double kAtSite_m = 0.9;
  /// Metres of strips given up after their tries.
  double unflown_m() const { return unflown_m_; }
  /// What the robot's own battery holds, as far as is known.
  double robot_energy() const { return robot_ ? robot_->energy : task_.charger.battery.capacity; }
  /// States refused so far.
  std::uint64_t refused() const { return refused_; }
  /// Whether everything is flown or ahead in the plan.
  bool complete() const {
    return plan_.lacks.empty() && given_up_.empty() && gaps_.empty() && !told_no_plan_;
  }

 private:
  PlanKeeper(Task task, planner::Terrain terrain, const KeeperParams& params, LivePlan plan,
             std::vector<FieldReport> fields, std::shared_ptr<const Ways> ways);
  EnergyModel energy_model() const;
  FlightModel model() const { return {task_.vehicle, energy_model(), terrain_, ways_.get()}; }
  double energy_now() const;
  bool covers(std::size_t leg) const;
  /// What is flown before a change can reach the aircraft.
  struct Commitment {
    std::size_t legs = 0;      ///< begun by then
    double into_last_m = 0.0;  ///< of the last of them, from its entry, or beyond its exit
  };
  Commitment committed() const;
  Commitment committed_on_path() const;
  double into_leg_m(std::size_t leg, double ahead_s) const;
  bool is_on_path() const;
  bool is_held_up() const;
  bool is_path_of_plan() const { return is_on_path() && path_.coverage_revision() >= legs_revision_; }
  std::optional<FlightCost> to_next_landing() const;
  FlightCost legs_to_next_landing() const;
  double surcharge() const;
  FlightCost flight_over(std::span<const Leg> legs, const ScheduleStart& start) const;
  FlightCost flight_to(const Rendezvous* landing, const ScheduleStart& start) const;
  RestParams rest_params() const;
  double landing_spare() const;

  bool refuse();
  void follow_progress(const std::optional<AircraftView>& before, const AircraftView& vehicle);
  TrackParams track_params() const;
  void miss_leg(double duration_s);
  void finish_leg(std::size_t leg);
  Leg flown_part(Leg leg, const std::vector<Gap>& gaps) const;
  void watch(const AircraftView& vehicle);
  bool tell_given_up(bool changed);
  void pass_meeting(const Vec3& from_m);
  bool may_retry();
  bool review_capacity(double capacity);
  bool review_flight();
  void note_flight(const AircraftView& before, const AircraftView& now);
  void learn_consumption(const BatteryView& before, const BatteryView& now);
  /// To come down where a change reaches the aircraft.
  struct DownNow {
    FlightCost there;
    FlightCost descent;
  };
  DownNow down_now() const;
  double spare_to_come_down(const FlightCost& descent, const Vec3& velocity_mps, double height_m) const;
  bool is_last_chance(const FlightCost& to_landing) const;
  bool review_wait();
  std::string what_holds_it_up() const;
  bool review_ground();
  bool tell_no_plan();
  bool review_gaps();
  enum class Otherwise : std::uint8_t { kLand, kGoOn };  ///< where nothing keeps the reserve
  bool solve_in_flight(const std::string& reason, Otherwise otherwise = Otherwise::kLand);
  bool solve_on_ground(const std::string& reason);
  bool solve_at_start(const std::vector<Leg>& legs, const std::string& reason);
  std::optional<RestPlan> plan_from_robot(std::vector<Leg> legs, ScheduleStart& start, bool is_carried);
  bool solve_docked(const std::string& reason);
  bool top_up_charge();
  bool come_down(const std::string& reason);
  std::size_t split_ahead(Rest& rest, const Commitment& begun);
  std::size_t within_reach(std::vector<Leg>& legs, std::size_t before_landing);
  void land_at_once(std::vector<Leg> legs, std::size_t before_landing, const std::string& reason);
  void keep_track_of_leg(const Vec3& entry_m, bool covering);
  double robot_arrives_s(const Vec3& site_m) const;
  bool is_robot_limited() const { return std::isfinite(task_.charger.battery.capacity); }
  RobotStart robot_start() const;
  void send_robot(LivePlan& plan) const;
  void note_refill(const RobotView& before, const RobotView& now);
  bool is_robot_stranded() const;
  bool tell_stranded();
  bool review_robot_energy();
  Rendezvous meeting_at(const ScheduleStart& docked, double land_s, const Recharge& charge) const;
  Leg point_leg(const Vec3& at_m);
  Vec3 point_ahead() const;
  Vec3 lifted(Vec3 at_m) const;
  void adopt(RestPlan rest, const std::string& reason);
  void note_revision(const std::string& reason);
  ScheduleStart start_in_air() const;
  std::vector<Leg> unflown_legs(std::size_t committed = 0);
  std::vector<Leg> cut_to_battery(std::vector<Leg> legs, std::size_t from);
  std::vector<Leg> unseen_parts(const SubCell& cell, const std::vector<Leg>& flown);
  std::vector<Leg> flown_legs(std::size_t committed) const;
  bool replace_aircraft(const AircraftView& vehicle);
  bool begin_anew(const AircraftView& vehicle, const std::string& reason);
  Status take_cells(const std::vector<SubCell>& cells);
  bool at_meeting(const AircraftView& vehicle) const;

  Task task_;
  double capacity_as_asked_;  ///< that of the task's battery, whatever the one in use holds
  planner::Terrain terrain_;
  KeeperParams params_;
  LivePlan plan_;
  std::vector<FieldReport> fields_;
  std::shared_ptr<const Ways> ways_;
  std::optional<AircraftView> vehicle_;
  std::optional<BatteryView> battery_;
  std::optional<RobotView> robot_;
  PathAhead path_;
  std::vector<Leg> told_legs_;       ///< of the newest revision
  std::uint32_t legs_revision_ = 0;  ///< the newest in which the flight to the next landing is another
  std::vector<Leg> retired_;         ///< flown by aircraft before this one, no longer in the plan
  std::optional<StripTrack> track_;
  std::size_t tracked_leg_ = 0;
  /// By leg: those up to the one under way, while one before them is not done.
  std::map<std::size_t, StripTrack> later_;
  std::vector<Leg> gaps_;               ///< left out, not in the plan yet
  std::map<std::uint32_t, int> tries_;  ///< by sub-cell: how often it has been a gap
  std::uint32_t next_id_ = 0;
  double unflown_m_ = 0.0;
  std::string given_up_;   ///< stretches, in words
  bool gives_up_ = false;  ///< a stretch, which is not told yet
  std::uint64_t refused_ = 0;
  double landed_since_s_ = 0.0;
  bool told_short_ = false;   ///< in this flight
  std::string told_overdue_;  ///< what holds it up, in this stay on the ground
  double told_overdue_s_ = -1e9;
  bool told_no_plan_ = false;   ///< in this stay on the ground
  bool told_stranded_ = false;  ///< since the robot had energy
  std::string no_plan_;         ///< why the last solution failed
  double last_shift_s_ = -1e9;
  std::optional<double> promised_s_;  ///< when the robot, now late, was to be at the next meeting
  double robot_reviewed_s_ = -1e9;    ///< when its energy was looked at last
  double retry_s_ = -1e9;             ///< a solution that failed is not tried again before
  bool has_flown_ = false;
  Consumption consumption_;
  bool all_aloft_ = false;  ///< since the last battery sample
  /// What obstacles took of the sorties since the last landing where it was planned, which fell short by it:
  /// kept at hand by what is planned on the ground, or the next would fall short as well.
  double detour_energy_ = 0.0;
  bool lands_at_once_ = false;          ///< until it has landed nothing else is decided
  std::optional<double> solved_slack_;  ///< energy to spare at the next landing when last solved for it
};

}  // namespace swallowtail::coverage
