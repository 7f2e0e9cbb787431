#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "planner/base/stop.hpp"
#include "planner/path/certifier.hpp"
#include "planner/path/path.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::planner {

enum class Verdict : std::uint8_t { kCertified, kContingency, kNoSafePath };

struct ReplanRequest {
  Vec3 start_m = Vec3::Zero();
  double start_time_s = 0.0;
  Vec3 start_velocity_mps = Vec3::Zero();  ///< zero: it stands; else the first segment's turn is judged against it
  std::vector<RoutePoint> route;           ///< the legs ahead; the last point is the goal or the landing
};

struct ReplanReport {
  Verdict verdict = Verdict::kNoSafePath;
  TimedPath path;             ///< certified as a whole whenever the verdict is not kNoSafePath
  Certificate certificate;
  std::string reason;         ///< "route is clear", "2 detours", "waits 6 s for obstacle 9", "goal blocked by obstacle 3", …
  std::uint64_t evaluations = 0;
  double wall_ms = 0.0;
};

/// Incremental anytime replanner: keeps what of the route is certified, goes round or waits out what is not (the butterflies choose the corridor), and falls back to a contingency:
/// fly on as far as it is certified and hold there, else hold where it is, else land. Everything it returns as flyable has passed the certifier.
class Replanner {
 public:
  struct Params {
    int detour_waypoints = 4;
    int population = 24;
    double max_wait_s = 60.0;
    std::uint64_t seed = 1;
  };

  Replanner(const VehicleLimits& limits, const Params& params);
  ~Replanner();

  ReplanReport plan(std::shared_ptr<const World> world, const ReplanRequest& request, const StopCondition& stop);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swallowtail::planner
