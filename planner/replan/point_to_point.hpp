#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planner/base/clock.hpp"
#include "planner/base/result.hpp"
#include "planner/base/stop.hpp"
#include "planner/path/certifier.hpp"
#include "planner/path/path.hpp"
#include "planner/replan/corridor_search.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::planner {

enum class PlanStatus : std::uint8_t {
  kCertified,
  kNoneFound,
  kStartBlocked,
  kGoalBlocked,
  kOutOfBounds,
  kInterrupted,  ///< before anything certified was found
};
/// "certified", "none_found", "start_blocked", "goal_blocked", "out_of_bounds", "interrupted"
const char* name(PlanStatus status);

struct PlanParams {
  std::string algorithm = "boa";  ///< a name of swarm/registry.hpp
  int waypoints = 6;              ///< midpoints of the swarm's paths, 1 to 64; the answer may have more
  int population = 24;
  swarm::Settings settings{};  ///< other parameters of the algorithm by name, over its defaults
  CorridorParts parts{};       ///< what takes part: leave something out to see what it is worth
};
Status validate(const PlanParams& params);

struct PlanRequest {
  Vec3 start_m = Vec3::Zero();
  Vec3 goal_m = Vec3::Zero();
  double start_time_s = 0.0;  ///< mission time; matters where obstacles move
  VehicleLimits limits;
  PlanParams params;
  std::uint64_t seed = 1;
};

/// One point of the convergence curve of certified paths.
struct PlanProgress {
  std::uint64_t evaluations = 0;
  double wall_ms = 0.0;
  double best_length_m = 0.0;
};

struct PlanReport {
  PlanStatus status = PlanStatus::kNoneFound;
  std::string reason;       ///< a sentence for people, by which obstacle it is blocked for instance
  TimedPath path;           ///< certified; empty unless the status is kCertified
  Certificate certificate;  ///< of `path`; else of the straight line
  double length_m = 0.0;
  double duration_s = 0.0;
  double cost = 0.0;  ///< the optimiser's: length ÷ straight line, and penalties
  std::uint64_t evaluations = 0;
  double wall_ms = 0.0;  ///< 0 without a clock
  double first_certified_ms = 0.0;
  std::vector<PlanProgress> history;  ///< each improvement of the certified path
};

/// Plans from one point to another: the straight line if it is clear; else a tree of sidesteps gives a path
/// at once, the named algorithm and more trees choose corridors in rounds of different boxes and seeds, a
/// taut string shortens what they find (corridor_search.hpp), and the certifier decides. Anytime: goes on
/// until `stop` or until rounds no longer improve. Without a limit in `stop` it uses kDefaultEvaluations; a
/// goal that cannot be reached is kNoneFound after that. `observer` is called on each improvement (may be
/// empty). Times come from `clock` (may be null: all wall times 0). A scene scaled by a power of two gives
/// the scaled path, bit for bit. Errors: limits, parameters or points that do not validate. A path that is
/// not certified is never returned.
Result<PlanReport> plan_path(std::shared_ptr<const World> world, const PlanRequest& request,
                             const StopCondition& stop, const Clock* clock = nullptr,
                             const std::function<void(const PlanProgress&)>& observer = {});

inline constexpr std::uint64_t kDefaultEvaluations = 50'000;

}  // namespace swallowtail::planner
