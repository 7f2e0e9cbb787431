#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/base/clock.hpp"
#include "planner/participant/convert.hpp"
#include "planner/participant/planner_participant.hpp"
#include "planner/path/certifier.hpp"
#include "qos/memory/bus.hpp"

namespace swallowtail::planner {

/// A planner on a memory bus, a wire to feed it, and an aircraft that is exactly where its path says. `run`
/// moves wall and mission time on together.
class PlannerFixture {
 public:
  PlannerFixture() : wire_(network_.make_bus()) {
    clocks_ = open<data::MissionClock>();
    vehicles_ = open<data::VehicleState>();
    tasks_ = open<data::CoverageTask>();
    plans_ = open<data::CoveragePlan>();
    goals_ = open<data::Goal>();
    obstacles_ = open<data::Obstacle>();
    chargers_ = open<data::ChargerState>();
    orders_ = open<data::ChargerPlan>();
    tiles_ = open<data::TerrainTile>();
    const Status subscribed =
        wire_->subscribe<data::PathPlan>({.on_sample = [this](const data::PathPlan& plan) {
          if (!paths.empty() && paths.back().revision == plan.revision) return;
          paths.push_back(plan);
          if (plan.verdict != data::PathVerdict::kNoSafePath) log_.join(to_path(plan.waypoints), time_s);
        }});
    if (!subscribed.ok()) throw std::runtime_error(subscribed.error().message);
    vehicle.vehicle_id = 1;
    start_planner();
  }

  void start_planner(std::int32_t strength = 10) {
    start_planner_with({.vehicle_id = 1, .ownership_strength = strength});
  }
  void start_planner_with(const PlannerOptions& options) {
    planner.reset();
    planner_bus_.reset();
    planner_bus_ = network_.make_bus();
    planner = std::move(PlannerParticipant::make(*planner_bus_, wall, options)).value();
  }
  void stop_planner() {
    planner.reset();
    planner_bus_.reset();
  }

  data::CoverageTask task() const {
    data::CoverageTask t;
    t.vehicle_id = 1;
    t.fields = {{1, 20.0}};
    t.rings = {{0, 0, 4, false}};
    t.points = {{0, 0}, {200, 0}, {200, 100}, {0, 100}};
    return t;
  }

  /// Strips of 100 m, 10 m apart, at 20 m; the transfer of each leg as given.
  data::CoveragePlan plan(const std::vector<data::Transfer>& transfers, std::uint32_t revision = 1) const {
    data::CoveragePlan p;
    p.task_id = 1;
    p.vehicle_id = 1;
    p.revision = revision;
    for (std::size_t i = 0; i < transfers.size(); ++i) {
      const double x = 10.0 * static_cast<double>(i);
      const double from = i % 2 == 0 ? 0.0 : 100.0;
      data::Leg leg;
      leg.sub_cell_id = static_cast<std::uint32_t>(i);
      leg.entry = {x, from, 20};
      leg.exit = {x, 100.0 - from, 20};
      leg.height_m = 20;
      leg.transfer = transfers[i];
      p.legs.push_back(leg);
    }
    return p;
  }

  data::Obstacle sphere(std::uint32_t id, const data::Vec3& at, double radius_m) const {
    data::Obstacle o;
    o.obstacle_id = id;
    o.position = at;
    o.radius_m = radius_m;
    return o;
  }

  void publish(const data::CoverageTask& t) { ok(tasks_->publish(t)); }
  void publish(const data::CoveragePlan& p) { ok(plans_->publish(p)); }
  void publish(const data::Goal& g) { ok(goals_->publish(g)); }
  void publish(const data::Obstacle& o) { ok(obstacles_->publish(o)); }
  void publish(const data::ChargerState& c) { ok(chargers_->publish(c)); }
  void publish(const data::ChargerPlan& o) { ok(orders_->publish(o)); }
  void publish(const data::TerrainTile& t) { ok(tiles_->publish(t)); }
  void remove(const data::Obstacle& o) { ok(obstacles_->dispose(o)); }

  void charger_ready_at(const data::Vec3& position) {
    data::ChargerState c;
    c.charger_id = 1;
    c.time_s = time_s;
    c.position = position;
    c.activity = data::ChargerActivity::kReady;
    publish(c);
  }

  void run(double seconds) {
    for (double done = 0.0; done < seconds - 1e-9; done += 0.05) {
      time_s += 0.05;
      wall.advance(0.05);
      fly();
      ok(clocks_->publish({time_s, 1.0, data::ClockState::kRunning}));
      vehicle.time_s = time_s;
      ok(vehicles_->publish(vehicle));
      if (planner) {
        ok(planner->step());
        ok(planner->beat());
      }
    }
  }

  const data::PathPlan& path() const { return paths.back(); }
  std::size_t path_count() const { return paths.size(); }
  Vec3 position() const { return to_vec(vehicle.position); }

  MemoryNetwork network_;
  ManualClock wall;
  std::unique_ptr<Bus> wire_;
  std::unique_ptr<Bus> planner_bus_;
  std::unique_ptr<PlannerParticipant> planner;
  data::VehicleState vehicle;
  std::vector<data::PathPlan> paths;
  double time_s = 0.0;
  bool follows = true;
  double largest_jump_m = 0.0;

 private:
  template <class T>
  std::unique_ptr<Publisher<T>> open() {
    auto publisher = wire_->publisher<T>();
    ok(publisher ? Status() : Status(publisher.error()));
    return std::move(publisher).value();
  }

  static void ok(const Status& status) {
    if (!status.ok()) throw std::runtime_error(status.error().message);
  }

  void fly() {
    if (!follows || log_.empty() || time_s < log_.begin_s()) {
      if (log_.empty()) return;
    }
    const Vec3 before = position();
    const Vec3 after = log_.position(time_s);
    if (vehicle.mode != data::VehicleMode::kLanded || time_s > log_.begin_s()) {
      largest_jump_m = std::max(largest_jump_m, (after - before).norm() - 0.05 * 8.0);
    }
    vehicle.position = to_data(after);
    vehicle.velocity_mps = to_data(log_.velocity(time_s));
    const TimedWaypoint& w = log_.target(time_s);
    if (time_s >= log_.end_s()) {
      vehicle.mode = after.z() < 0.3 ? data::VehicleMode::kLanded : data::VehicleMode::kHolding;
    } else if (time_s >= log_.begin_s() || vehicle.mode != data::VehicleMode::kLanded) {
      vehicle.mode = w.phase == Phase::kTakeOff   ? data::VehicleMode::kTakingOff
                     : w.phase == Phase::kLanding ? data::VehicleMode::kLanding
                     : w.phase == Phase::kCover   ? data::VehicleMode::kCovering
                     : w.phase == Phase::kHold    ? data::VehicleMode::kHolding
                                                  : data::VehicleMode::kTransfer;
      vehicle.path_revision = paths.back().revision;
    }
    if (last_phase_ == Phase::kCover &&
        (w.leg_index != last_leg_ || w.phase == Phase::kLanding || time_s >= log_.end_s()) &&
        !log_.covers_later(last_leg_, time_s)) {
      vehicle.legs_done = std::max(vehicle.legs_done, last_leg_ + 1);
    }
    last_phase_ = w.phase;
    last_leg_ = w.leg_index;
    vehicle.leg_index = w.leg_index;
  }

  FlightLog log_;
  Phase last_phase_ = Phase::kHold;
  std::uint32_t last_leg_ = 0;
  std::unique_ptr<Publisher<data::MissionClock>> clocks_;
  std::unique_ptr<Publisher<data::VehicleState>> vehicles_;
  std::unique_ptr<Publisher<data::CoverageTask>> tasks_;
  std::unique_ptr<Publisher<data::CoveragePlan>> plans_;
  std::unique_ptr<Publisher<data::Goal>> goals_;
  std::unique_ptr<Publisher<data::Obstacle>> obstacles_;
  std::unique_ptr<Publisher<data::ChargerState>> chargers_;
  std::unique_ptr<Publisher<data::ChargerPlan>> orders_;
  std::unique_ptr<Publisher<data::TerrainTile>> tiles_;
};

}  // namespace swallowtail::planner
