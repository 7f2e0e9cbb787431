#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/stop.hpp"
#include "planner/kernels/obstacle_field.hpp"
#include "planner/replan/replanner.hpp"
#include "planner/replan/timed_route.hpp"

namespace swallowtail::planner {

/// Where a timed route may not be flown, as judged by the field's distances in steps along it.
struct Blockage {
  double begins_s = 0.0;
  double ends_s = 0.0;            ///< infinite: until the end
  std::uint32_t obstacle_id = 0;  ///< 0: the ground
  bool moves = false;
  bool on_cover = false;
};

/// Repairs one blocked stretch after the other, in the order of time. Borrows everything it is given.
class RouteRepair {
 public:
  RouteRepair(std::shared_ptr<const World> world, const ClearanceQuery& query, const VehicleLimits& limits,
              const Replanner::Params& params, const StopCondition& stop, const TimedPath& previous);

  /// True if all of it is certified in the end; else `blocked` says where it stays blocked.
  bool repair(TimedRoute& timed);

  const Violation& blocked() const { return blocked_; }
  bool goal_is_blocked() const { return goal_is_blocked_; }
  bool out_of_time() const { return out_of_time_; }
  std::uint64_t evaluations() const { return evaluations_; }
  int detours() const { return detours_; }
  int waits() const { return waits_; }
  double skipped_cover_m() const { return skipped_cover_m_; }
  /// What was done, "" if nothing.
  std::string summary() const;

 private:
  struct Candidate {
    Spliced spliced;
    double rejoin_s = 0.0;
    double waited_s = 0.0;
  };

  /// Between two looks along a route, where a blockage's ends are sought.
  double step_s() const;
  bool point_blocked(const TimedRoute& timed, double time_s, double margin_m) const;
  Blockage find_blockage(const TimedRoute& timed, const Violation& violation) const;
  bool repair_stretch(TimedRoute& timed, const Violation& violation);
  std::optional<Candidate> try_wait(const TimedRoute& timed, const Blockage& blockage, double earliest_s);
  std::optional<Candidate> try_detour(const TimedRoute& timed, const Blockage& blockage, double earliest_s,
                                      int attempt);
  std::optional<Candidate> judge(const TimedRoute& timed, const Splice& change) const;
  bool stretch_clear_after(const TimedRoute& timed, double from_s, double to_s, double wait_s) const;
  std::optional<Violation> first_violation(const TimedPath& path, std::size_t from, std::size_t to) const;
  std::vector<Vec3> previous_way(const Vec3& from, const Vec3& to) const;

  std::shared_ptr<const World> world_;
  const ClearanceQuery& query_;
  const VehicleLimits& limits_;
  const Replanner::Params& params_;
  const StopCondition& stop_;
  const TimedPath& previous_;
  ObstacleField field_;
  std::size_t frontier_ = 0;  ///< index in the path up to which it is certified
  double slope_share_ = 0.15;
  Violation blocked_;
  bool goal_is_blocked_ = false;
  bool out_of_time_ = false;
  std::uint64_t evaluations_ = 0;
  int detours_ = 0;
  int waits_ = 0;
  double waited_s_ = 0.0;
  std::uint32_t waited_for_ = 0;
  double skipped_cover_m_ = 0.0;
};

}  // namespace swallowtail::planner
