#include "planner/participant/planner_participant.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "planner/base/checks.hpp"
#include "planner/participant/convert.hpp"
#include "planner/participant/no_fly.hpp"
#include "planner/path/certifier.hpp"
#include "planner/replan/point_to_point.hpp"

namespace swallowtail::planner {
namespace {

using data::VehicleMode;

constexpr double kGoalHold_s = 10.0;
/// Wall time for the search of the whole way to a goal while the mission has not begun.
constexpr double kSearchBeforeStart_s = 0.9;
/// A path is published again after this wall time, so that the writer's deadline is kept.
constexpr double kRepublish_s = 4.0;
/// A mission time this far behind is a new mission.
constexpr double kRestart_s = 5.0;
/// The vehicle is not where its path says beyond this.
constexpr double kOffPath_m = 1.5;
/// On the ground within this of the charger's place, or of the task's start, it may be let go.
constexpr double kBeside_m = 3.0;
constexpr std::size_t kMaxReason = 128;
constexpr double kLeastLead_s = 0.5;
constexpr double kLeastLeadWall_s = 0.15;
constexpr double kLeadReserveWall_s = 0.06;

bool is_on_ground(const data::VehicleState& v) {
  return v.mode == VehicleMode::kLanded || v.mode == VehicleMode::kDocked;
}

}  // namespace

Status validate(const PlannerOptions& options) {
  if (!is_within(options.budget_ms, 1.0, 10000.0))
    return bad_input("The planner's budget must be 1 to 10000 ms.");
  if (options.vehicle_id == 0) return bad_input("The vehicle id must not be 0.");
  if (!is_within(options.obstacle_acceleration_mps2, 0.0, 100.0))
    return bad_input("The acceleration of obstacles must be 0 to 100 m/s².");
  if (options.ownership_strength < 0) return bad_input("The ownership strength must not be negative.");
  return {};
}

double PlannerParticipant::lead_s(double rate, double budget_ms) {
  const double wall_s = std::max(kLeastLeadWall_s, 1e-3 * budget_ms + kLeadReserveWall_s);
  return std::max(kLeastLead_s, rate * wall_s);
}

Result<std::unique_ptr<PlannerParticipant>> PlannerParticipant::make(Bus& bus, const Clock& clock,
                                                                     PlannerOptions options) {
  if (Status valid = validate(options); !valid) return valid.error();
  std::unique_ptr<PlannerParticipant> planner(new PlannerParticipant(bus, clock, options));
  if (Status connected = planner->connect(); !connected) return connected.error();
  return planner;
}

PlannerParticipant::PlannerParticipant(Bus& bus, const Clock& clock, PlannerOptions options)
    : bus_(bus), clock_(clock), options_(options) {
  last_step_wall_s_ = clock.now_s();
}

void PlannerParticipant::use_limits(const data::VehicleLimits& limits, std::uint64_t seed) {
  limits_ = to_limits(limits);
  Replanner::Params params;
  params.seed = seed;
  replanner_.emplace(limits_, params, &clock_);
}

void PlannerParticipant::take_task(const data::CoverageTask& task) {
  if (task_ && *task_ == task) return;
  auto no_fly = no_fly_parts(task);
  if (!no_fly) {
    bus_.count_rejection("CoverageTask", "no-fly area not usable");
    return status_->set_health(data::Health::kDegraded, no_fly.error().message);
  }
  use_limits(task.vehicle, task.seed);
  keeper_.set_has_terrain(task.has_terrain);
  keeper_.set_no_fly(std::move(*no_fly), std::max(0.0, limits_.clearance_m() - kOffNoFly_m));
  no_drive_ = areas_of(task, data::AreaKind::kNoDrive);
  inbox_->charger_id.store(task.charger.charger_id);
  mission_changed_ = true;
  task_ = task;
}

void PlannerParticipant::take_mission() {
  if (auto task = inbox_->task.take(); task && task->vehicle_id == options_.vehicle_id) take_task(*task);
  if (auto plan = inbox_->coverage.take()) {
    const bool same =
        coverage_ && !log_.empty() && same_ahead(*coverage_, *plan, vehicle_ ? vehicle_->legs_done : 0);
    mission_changed_ = mission_changed_ || !same;
    coverage_ = std::move(plan);
  }
  if (auto goal = inbox_->goal.take()) {
    if (!goal_ || *goal_ != *goal) {
      use_limits(goal->vehicle, goal->seed);
      keeper_.set_has_terrain(goal->has_terrain);
      const Vec3 lo = to_vec(goal->bounds_min);
      const Vec3 hi = to_vec(goal->bounds_max);
      if ((lo.array() < hi.array()).all()) keeper_.set_bounds({lo, hi});
      mission_changed_ = true;
    }
    goal_ = std::move(goal);
  }
}

void PlannerParticipant::take_path() {
  auto plan = inbox_->path.take();
  if (!plan) return;
  const bool news = plan->revision > revision_;
  revision_ = std::max(revision_, plan->revision);
  if (!news || plan->waypoints.empty() || plan->verdict == data::PathVerdict::kNoSafePath) return;
  // Somebody else plans for this vehicle: a stronger planner, or oneself before a restart.
  log_.join(to_path(plan->waypoints), last_now_s_);
  verdict_ = plan->verdict == data::PathVerdict::kCertified ? Verdict::kCertified : Verdict::kContingency;
}

void PlannerParticipant::take_inbox() {
  if (auto vehicle = inbox_->vehicle.take()) {
    revision_ = std::max(revision_, vehicle->path_revision);
    vehicle_ = vehicle;
  }
  if (auto charger = inbox_->charger.take()) charger_ = charger;
  if (auto orders = inbox_->orders.take()) orders_ = std::move(orders);
  take_changes();
  if (options_.obstacle_acceleration_mps2 > 0.0) {
    const double answered_s = (1 << late_) * lead_s(inbox_->time.rate(), options_.budget_ms);
    keeper_.set_turn_margin(0.5 * options_.obstacle_acceleration_mps2 * answered_s * answered_s);
  }
  take_mission();
  take_path();
}

bool PlannerParticipant::has_mission() const {
  return replanner_ && ((task_ && coverage_ && coverage_->task_id == task_->task_id) || goal_);
}

bool PlannerParticipant::meets_charger_first() const {
  return orders_ && orders_->task_id == task_->task_id &&
         std::ranges::any_of(orders_->rendezvous, [this](const data::Rendezvous& meeting) {
           return meeting.kind == data::StopKind::kMeeting &&
                  meeting.rendezvous_id == 2 * vehicle_->legs_done;
         });
}

bool PlannerParticipant::may_take_off() const {
  if (!coverage_ || !task_) return goal_.has_value();
  if (vehicle_->legs_done >= coverage_->legs.size()) return false;
  const Vec3 position = to_vec(vehicle_->position);
  const bool at_start = (position - to_vec(task_->start)).head<2>().norm() <= kBeside_m;
  if (vehicle_->legs_done == 0 && at_start && vehicle_->mode == VehicleMode::kLanded &&
      !vehicle_->path_revision && !meets_charger_first())
    return true;
  return charger_ && charger_->activity == data::ChargerActivity::kReady &&
         (to_vec(charger_->position) - position).head<2>().norm() <= kBeside_m;
}

bool PlannerParticipant::lost_track() const {
  if (log_.empty() || vehicle_->time_s < log_.begin_s()) return false;
  return (log_.position(vehicle_->time_s) - to_vec(vehicle_->position)).norm() > kOffPath_m;
}

Status PlannerParticipant::act(double now_s) {
  if (!has_mission() || !vehicle_ || keeper_.world() == nullptr) return {};
  if (lost_track()) log_.clear();
  log_.note(now_s);
  const bool world_changed = keeper_.take_changed();
  const bool changed = std::exchange(mission_changed_, false) || world_changed;
  return is_on_ground(*vehicle_) ? act_on_ground(now_s, changed) : act_in_flight(now_s, changed);
}

Status PlannerParticipant::act_on_ground(double now_s, bool changed) {
  const double grace_s = std::max(2.0, 0.5 * inbox_->time.rate());
  if (!log_.empty()) {
    const bool waits_for_start = vehicle_->time_s < log_.begin_s() + grace_s;
    const bool is_over = vehicle_->time_s >= log_.end_s();
    const bool not_taken = vehicle_->time_s >= log_.begin_s() + grace_s && !is_over;
    if (is_over || not_taken) log_.clear();
    const double lead = (1 << late_) * lead_s(inbox_->time.rate(), options_.budget_ms);
    // What comes too late for another take-off is taken up on the way.
    if (changed && waits_for_start && !is_over && now_s + lead >= log_.begin_s())
      return act_in_flight(now_s, changed);
    if (waits_for_start && !is_over && !changed) {
      changed_wall_s_ = 0.0;
      return {};
    }
  }
  if (!may_take_off() || clock_.now_s() < retry_wall_s_) {
    owes_path_ = owes_path_ || (changed && !log_.empty());
    changed_wall_s_ = 0.0;
    return {};
  }
  return plan_from_ground(now_s);
}

std::vector<RoutePoint> PlannerParticipant::route_from(const RouteStart& start, double join_s) {
  const Terrain& terrain = keeper_.world_now()->terrain();
  if (!start.on_ground && !log_.empty() && join_s < log_.end_s() &&
      log_.target(join_s).phase == Phase::kLanding) {
    std::vector<RoutePoint> route;
    for (const TimedWaypoint& w : log_.rest(join_s))
      route.push_back({w.position_m, w.phase, w.leg_index, 0.0});
    return route;
  }
  if (coverage_ && task_) return sortie_route(*coverage_, sortie_, start, terrain, limits_);
  return route_to_goal(start, join_s);
}

std::vector<RoutePoint> PlannerParticipant::route_to_goal(const RouteStart& start, double join_s) {
  const Terrain& terrain = keeper_.world_now()->terrain();
  const Vec3 goal_m = to_vec(goal_->position);
  const Vec3 from_m = goal_way_start(*goal_, start, terrain, limits_);
  const bool waits = !inbox_->time.running();
  if (waits || log_.empty() || verdict_ == Verdict::kContingency || !way_.leads_to(goal_m)) {
    const double search_s = waits ? kSearchBeforeStart_s : 0.5e-3 * options_.budget_ms;
    way_.search(
        keeper_.world_now(), limits_, from_m, join_s, goal_m, goal_->seed,
        {.clock = &clock_, .deadline_s = clock_.now_s() + search_s, .max_evaluations = kDefaultEvaluations});
  }
  return goal_route(*goal_, start, terrain, limits_, way_.corners_ahead(from_m), kGoalHold_s);
}

Status PlannerParticipant::plan_from_ground(double now_s) {
  RouteStart start;
  start.position_m = to_vec(vehicle_->position);
  start.on_ground = true;
  start.leg = vehicle_->legs_done;
  if (coverage_ && task_) sortie_ = sortie_from(*coverage_, start.leg, start.position_m);
  log_.clear();
  const double begin_s = now_s + (1 << late_) * lead_s(inbox_->time.rate(), options_.budget_ms);
  const double wall_s = clock_.now_s();
  std::vector<RoutePoint> route = route_from(start, begin_s);
  const StopCondition stop{.clock = &clock_, .deadline_s = clock_.now_s() + 1e-3 * options_.budget_ms};
  const ReplanReport report =
      replanner_->plan(keeper_.world(), {start.position_m, begin_s, Vec3::Zero(), std::move(route)}, stop);
  retry_wall_s_ = clock_.now_s() + kRetryWall_s;
  // On the ground a contingency is to stay there.
  if (report.verdict != Verdict::kCertified) {
    fail(report);
    return {};
  }
  return publish(report, now_s, 1e3 * (clock_.now_s() - wall_s));
}

void PlannerParticipant::fail(const ReplanReport& report) {
  changed_wall_s_ = 0.0;
  owes_path_ = true;
  status_->set_health(data::Health::kDegraded, "no safe path: " + report.reason);
}

Status PlannerParticipant::publish(const ReplanReport& report, double now_s, double replan_ms) {
  const double begin_s = report.path.front().time_s;
  if (inbox_->time.running() && inbox_->time.now_s(clock_.now_s()) > begin_s) {
    // Too late to be joined: again with a longer lead.
    late_ = std::min(late_ + 1, 3);
    retry_wall_s_ = 0.0;
    mission_changed_ = true;
    return {};
  }
  late_ = 0;
  data::PathPlan plan;
  plan.vehicle_id = options_.vehicle_id;
  plan.revision = ++revision_;
  plan.basis.coverage_revision = coverage_ && task_ ? coverage_->revision : 0;
  plan.basis.goal_revision = !(coverage_ && task_) && goal_ ? goal_->revision : 0;
  plan.basis.terrain_revision = keeper_.terrain_revision();
  plan.basis.obstacle_revision = keeper_.obstacle_revision();
  plan.basis.vehicle_time_s = vehicle_->time_s;
  plan.verdict = to_data(report.verdict);
  plan.reason = report.reason.substr(0, kMaxReason);
  plan.lands = report.lands;
  plan.length_m = length_m(report.path);
  plan.duration_s = report.path.back().time_s - begin_s;
  plan.clearance_min_m = std::min(report.certificate.clearance_min_m, 1e6);
  plan.replan_ms = replan_ms;
  plan.waypoints = to_data(report.path);
  if (plan.waypoints.size() > data::kMaxWaypoints) {
    plan.waypoints.resize(data::kMaxWaypoints);
    plan.lands = false;
  }
  if (Status sent = publisher_->publish(plan); !sent) return sent;
  log_.join(to_path(plan.waypoints), now_s);
  verdict_ = report.verdict;
  owes_path_ = false;
  published_wall_s_ = clock_.now_s();
  status_->count_replan();
  status_->add_latency_ms(changed_wall_s_ > 0.0 ? 1e3 * (published_wall_s_ - changed_wall_s_) : replan_ms);
  changed_wall_s_ = 0.0;
  const bool certified = report.verdict == Verdict::kCertified;
  status_->set_health(certified ? data::Health::kReady : data::Health::kDegraded, plan.reason);
  published_ = std::move(plan);
  return {};
}

Status PlannerParticipant::step() {
  const double wall_s = clock_.now_s();
  last_step_wall_s_ = wall_s;
  take_inbox();
  const double now_s = inbox_->time.now_s(wall_s);
  if (now_s < last_now_s_ - kRestart_s) {
    owes_path_ = false;
    log_.clear();
    published_.reset();
  }
  last_now_s_ = now_s;
  if (!inbox_->time.ended()) {
    if (Status acted = act(now_s); !acted) return acted;
  }
  if (published_ && clock_.now_s() >= published_wall_s_ + kRepublish_s) {
    published_wall_s_ = clock_.now_s();
    if (published_->revision == revision_) return publisher_->publish(*published_);
  }
  return {};
}

Status PlannerParticipant::beat() {
  if (clock_.now_s() - last_step_wall_s_.load() < kStuck_s) publisher_->assert_liveliness();
  return status_->step();
}

}  // namespace swallowtail::planner
