#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "coverage/schedule/plan.hpp"
#include "tests/support/replay_flight.hpp"

namespace swallowtail::test_support {

/// Seconds from one energy to a higher one, from the task's battery, summed in small steps.
double charging_s(const coverage::Task& task, double from, double to);

/// Where the robot may drive, as whoever made the task knows it.
struct ReplayRoads {
  std::vector<std::vector<Vec2>> roads;  ///< empty: it drives over open ground at its speed
  double road_speed_mps = 1.0;
  double off_road_speed_mps = 0.0;
  std::vector<coverage::Polygon> forbidden;
  double slope_max_rad = std::numeric_limits<double>::infinity();
};

/// Told of every straight piece that the robot drives.
using DriveWatch =
    std::function<void(double leaves_s, const Vec3& from_m, double arrives_s, const Vec3& to_m)>;

/// Where the ground robot is, and when it may leave.
class ReplayRobot {
 public:
  ReplayRobot(const coverage::Task& task, const ReplayRoads& roads, const GroundAt& ground)
      : held(task.charger.battery.capacity),
        task_(task),
        roads_(roads),
        ground_(ground),
        at_m_(task.charger.start_m) {}

  /// Drives from bend to bend to a place as fast as it can; tells how long it takes, and where it may not
  /// drive.
  double drive_to(const std::vector<Vec3>& bends_m, const Vec3& place_m, std::vector<std::string>& faults);

  /// Tells of the last drive, which ended then.
  void tell(const DriveWatch& watch, double arrives_s) const;

  /// Energy that is given to the aircraft.
  void give(double energy) { held -= energy * task_.charger.battery.per_charged; }

  double free_s = 0.0;
  double held = std::numeric_limits<double>::infinity();  ///< of its own battery

 private:
  double piece_s(const Vec3& to_m, std::vector<std::string>& faults) const;

  const coverage::Task& task_;
  const ReplayRoads& roads_;
  const GroundAt& ground_;
  Vec3 at_m_;
  struct Piece {
    Vec3 from_m;
    Vec3 to_m;
    double time_s;
  };
  std::vector<Piece> last_;
};

}  // namespace swallowtail::test_support
