#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "planner/base/clock.hpp"
#include "planner/base/stop.hpp"
#include "planner/path/certifier.hpp"
#include "planner/path/path.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::planner {

enum class Verdict : std::uint8_t { kCertified, kContingency, kNoSafePath };

struct ReplanRequest {
  Vec3 start_m = Vec3::Zero();
  double start_time_s = 0.0;
  Vec3 start_velocity_mps =
      Vec3::Zero();               ///< zero: it stands; else it stops first where the first turn is too sharp
  std::vector<RoutePoint> route;  ///< the legs ahead; the last point is the goal or the landing
};

struct ReplanReport {
  Verdict verdict = Verdict::kNoSafePath;
  TimedPath path;           ///< certified as a whole whenever the verdict is not kNoSafePath; empty if it is
  Certificate certificate;  ///< of `path`; of the route where there is none
  std::string
      reason;  ///< "route is clear", "2 detours", "waits 6 s for obstacle 9", "goal blocked by obstacle 3", …
  int detours = 0;
  int waits = 0;
  double skipped_cover_m = 0.0;  ///< of strips left out by detours
  bool lands = false;            ///< the path ends with a landing
  bool goal_is_blocked = false;  ///< the route's end is shut as far as is known
  std::uint64_t evaluations = 0;
  double wall_ms = 0.0;  ///< 0 without a clock
};

/// Incremental anytime replanner. The route is timed and certified; where it is blocked, the stretch from a
/// little before to a little after is replaced: by a wait where something moves and will be gone soon (always
/// preferred on a strip, elsewhere if it costs less), else by a detour whose corridor the butterflies choose
/// and whose timing takes moving obstacles where they will be. What of the route is clear stays as it is; a
/// strip is joined again right after the obstacle, and route points inside an obstacle are passed by. The
/// previous answer is among the first guesses. Where that fails, or the stop condition ends it: a contingency
/// (contingency.hpp). Everything it returns as flyable has passed the certifier, holds included. The stop
/// condition bounds the search; certifying and the contingency come on top. Without a limit in it the work is
/// bounded by kMaxStretches. Stopped by evaluations alone, the same requests in the same order give the same
/// answers.
class Replanner {
 public:
  struct Params {
    int detour_waypoints = 4;
    int population = 24;
    double max_wait_s = 60.0;
    double hold_s = 60.0;  ///< a contingency's hold is certified for so long if it can be
    std::uint64_t seed = 1;
  };
  static constexpr int kMaxStretches = 64;

  /// `clock` is for wall_ms only and may be null. Limits and params that do not validate give kNoSafePath
  /// with the reason.
  Replanner(const VehicleLimits& limits, const Params& params, const Clock* clock = nullptr);
  ~Replanner();
  Replanner(Replanner&&) noexcept;
  Replanner& operator=(Replanner&&) noexcept;

  ReplanReport plan(std::shared_ptr<const World> world, const ReplanRequest& request,
                    const StopCondition& stop);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
Status validate(const Replanner::Params& params);

}  // namespace swallowtail::planner
