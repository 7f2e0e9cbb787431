#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coverage/schedule/graph.hpp"
#include "coverage/schedule/task.hpp"
#include "planner/base/stop.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::coverage {

enum class LegKind : std::uint8_t { kCover, kReposition };

/// One straight flight at one altitude, and what follows it. Times are mission seconds, energies predictions.
struct Leg {
  std::uint32_t sub_cell_id = 0;
  std::uint32_t field_id = 0;
  LegKind kind = LegKind::kCover;
  Vec3 entry_m = Vec3::Zero();
  Vec3 exit_m = Vec3::Zero();
  double height_m = 0.0;  ///< above ground, as asked
  double width_m = 0.0;   ///< of the swath
  Transfer transfer = Transfer::kEnd;
  /// Where a flown transfer (F-F, F-FDU, F-DUF, F-DUFDU) bends on its way to the next leg, in order, at its
  /// altitude; empty when it is straight. After a landing at the exit it is flown no higher than the next leg
  /// and the ground ask for.
  std::vector<Vec3> transfer_m{};
  double energy_before = 0.0;
  double energy_after = 0.0;
  double start_s = 0.0;
  double end_s = 0.0;
};

/// Rendezvous ids grow along the plan: 2i at the entry of leg i, 2i + 1 at its exit.
constexpr std::uint32_t entry_id(std::size_t leg) { return static_cast<std::uint32_t>(2 * leg); }
constexpr std::uint32_t exit_id(std::size_t leg) { return static_cast<std::uint32_t>(2 * leg + 1); }
constexpr bool is_at_entry(std::uint32_t id) { return id % 2 == 0; }
/// How many legs of the plan come before it.
constexpr std::size_t legs_before(std::uint32_t id) { return (std::size_t{id} + 1) / 2; }

/// A meeting of aircraft and ground robot.
struct Rendezvous {
  std::uint32_t id = 0;
  Vec3 site_m = Vec3::Zero();  ///< on the ground
  double robot_arrives_s = 0.0;
  double land_s = 0.0;
  double arrive_by_s = 0.0;  ///< the aircraft's landing: the robot does best to be there by then
  double depart_s = 0.0;     ///< take-off
  double energy_from = 0.0;
  double charge_to = 0.0;  ///< energy on take-off
  double wait_s = 0.0;     ///< of the aircraft, landed
  bool carry = false;
  Vec3 carry_to_m = Vec3::Zero();
  /// Where the robot's ways to the site, and on to where it carries the aircraft, bend; empty when straight.
  std::vector<Vec3> robot_bends_m{};
  std::vector<Vec3> carry_bends_m{};
  /// Of a robot with a battery of its own (robot_trips.hpp): whether it comes by its depot, what it holds on
  /// its arrival, and when it has done here what it came for.
  bool by_depot = false;
  double robot_energy = 0.0;
  double robot_energy_left = 0.0;
};

/// The robot fetches new energy at its depot before it drives to a rendezvous, whose robot_bends_m then begin
/// there.
struct DepotVisit {
  std::size_t before = 0;  ///< index of that rendezvous
  double arrives_s = 0.0;
  double leaves_s = 0.0;
  std::vector<Vec3> bends_m{};  ///< on the way to the depot
};

struct FieldReport {
  std::uint32_t id = 0;
  std::string name;
  FieldStatus status = FieldStatus::kRefused;
  std::string reason;
  double area_m2 = 0.0;
  double covered_m2 = 0.0;
  double outside_m2 = 0.0;
  double sweep_rad = 0.0;
  int strips = 0;
  int cells = 0;
  int sub_cells = 0;
  int beyond_tolerance = 0;
  double wall_ms = 0.0;
};

enum class PlanStatus : std::uint8_t {
  kComplete,  ///< every field is planned
  kPartial,   ///< some fields are refused or covered only in part
};

struct PlanStatistics {
  int vertices =
      0;  ///< of the layered graph; of the graph without levels where the layered one would be too large
  std::size_t edges = 0;
  int neighbours = 0;      ///< X after widening
  double gtsp_cost = 0.0;  ///< of the layered graph's tour; 0: not solved
  std::string order_from;  ///< which search the order is from: "layered graph", "graph without levels",
                           ///< "flight search", "strip order"; " + local search"
  double full_graph_gap_percent =
      -1.0;  ///< cost of the pruned graph's tour above the full graph's; −1: not asked for
  std::uint64_t schedules_computed = 0;
  double gtsp_wall_s = 0.0;
  double wall_s = 0.0;
};

struct Plan {
  PlanStatus status = PlanStatus::kComplete;
  std::vector<FieldReport> fields;
  std::vector<std::string> notes{};  ///< sentences on what was taken although it may not be meant
  std::vector<SubCell> sub_cells;
  std::vector<Polygon> polygons;  ///< of the planned fields, as cut: where lines and transfers may run
  std::vector<Vec3> approach_m;   ///< where the flight from the start to the first leg bends, in order
  std::vector<Leg> legs;
  std::vector<Rendezvous> rendezvous;
  std::vector<DepotVisit> depot_visits{};  ///< in order; only with a robot whose battery is limited
  double robot_home_s = 0.0;               ///< the robot is back at its depot; 0: it stays where it is
  std::vector<Vec3> home_bends_m{};        ///< on its way there
  double cost = 0.0;                       ///< what was minimised: the makespan
  double makespan_s = 0.0;                 ///< from the start to the last landing
  double take_off_s = 0.0;                 ///< the first
  double flight_m = 0.0;
  double flight_s = 0.0;
  int recharges = 0;
  double wait_s = 0.0;      ///< landed, waiting for the robot
  double energy_min = 0.0;  ///< least energy at any predicted landing
  double energy_used = 0.0;
  double area_m2 = 0.0;          ///< of the planned fields
  double covered_percent = 0.0;  ///< of the planned fields' area
  PlanStatistics statistics;
};

enum class FullGraph : std::uint8_t { kSkip, kCompare };

struct PlanOptions {
  std::uint64_t seed = 1;
  StopCondition stop;  ///< deadline or request to stop; evaluations and iterations are limited by `mode`
  gtsp::Mode mode = gtsp::Mode::kFast;
  const Clock* clock = nullptr;  ///< for wall times in the report; without it they are 0
  double energy_margin = 0.08;   ///< allowance for wind and noise: flights are predicted to take so much more
  double energy_spare = 0.02;    ///< share of the capacity that landings keep besides the reserve
  double lead_s = 1.0;           ///< from the robot's ready until the aircraft leaves the ground
  FullGraph full_graph = FullGraph::kSkip;
  int threads = 1;
};

/// Task to timed schedule [COV Alg. 2]: cuts fields, orders sub-cells by the layered GTSP, then places
/// landings, charging and carrying exactly on a continuous battery, and improves the order under that
/// objective. Deterministic for a seed unless a deadline strikes. Errors: (kBadInput) the task; (kInfeasible)
/// no field can be planned, or the battery does not reach the first sub-cell; (kInterrupted) stop was
/// requested before there was a plan.
Result<Plan> plan_coverage(const Task& task, const planner::Terrain& terrain, const PlanOptions& options);

StopParams stop_params(const Task& task, const PlanOptions& options);

/// Round what transfers fly: no-fly areas and the holes of the planned fields' polygons.
Ways ways_of(const Task& task, std::span<const Polygon> polygons);

/// Cuts all fields of a task; ids of sub-cells are unique from 0 on.
struct FieldsCut {
  std::vector<FieldReport> reports;
  std::vector<SubCell> sub_cells;
  std::vector<Polygon> polygons;  ///< of the planned fields: where lines and transfers may run
};
FieldsCut cut_fields(const Task& task, const planner::Terrain& terrain, const PlanOptions& options);

}  // namespace swallowtail::coverage
