#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "idl/data/types.hpp"
#include "planner/path/path.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::sim {

/// What became of a PathPlan that was offered to the aircraft.
enum class Offer : std::uint8_t {
  kAccepted,
  kKnown,       ///< this revision has been offered before
  kNoSafePath,  ///< the planner has none; what is flown stays
  kNoWaypoints,
  kStaleStart,  ///< where it begins, the aircraft will not be
};

/// What the aircraft is and does at one instant.
struct Motion {
  double time_s = 0.0;
  Vec3 position_m = Vec3::Zero();
  Vec3 velocity_mps = Vec3::Zero();
  double yaw_rad = 0.0;  ///< counter-clockwise from east; kept where it does not move
  data::VehicleMode mode = data::VehicleMode::kLanded;
  std::uint32_t docked_charger_id = 0;
  std::uint32_t path_revision = 0;
  std::uint32_t coverage_revision = 0;
  std::uint32_t leg_index = 0;
  std::uint32_t legs_done = 0;

  bool on_ground() const { return mode == data::VehicleMode::kLanded || mode == data::VehicleMode::kDocked; }
};

/// A straight piece of flight.
struct Stretch {
  Vec3 from_m = Vec3::Zero();
  Vec3 to_m = Vec3::Zero();
};

/// An aircraft that is exactly where its path says. At the path's end it stands on the ground, if it touches
/// it, or holds. Landed, it can be taken on board by its charger.
class Aircraft {
 public:
  /// Greatest distance between where a new path begins and where the aircraft will be then.
  static constexpr double kJoin_m = 0.3;
  static constexpr double kTouchDown_m = 0.3;  ///< on the ground at or below this height
  static constexpr double kLegEnd_m = 1.5;     ///< a waypoint this near to a leg's exit is its end
  static constexpr double kDockReach_m = 3.0;
  static constexpr double kPlugSilence_s = 5.0;

  Aircraft(std::uint32_t vehicle_id, const Vec3& start_m, planner::Terrain terrain);

  /// Flown from its first waypoint's time on, if it joins the flight without a jump.
  Offer offer(const data::PathPlan& plan);
  /// Tells where legs end. Plans of several revisions are kept, because a path is flown by the one that it
  /// was made from.
  void learn_legs(const data::CoveragePlan& plan);
  /// The newest state of the charger that may take the aircraft on board.
  void see_charger(const data::ChargerState& charger) { charger_ = charger; }

  /// Another takes its place: it stands at `start_m`, has flown nothing, and knows no path.
  void replace(const Vec3& start_m);

  /// Flies on to a later time.
  const Motion& advance(double to_s);

  const Motion& motion() const { return motion_; }
  /// The waypoints that the last `advance` flew through: between them the flight is straight.
  const std::vector<Motion>& corners() const { return corners_; }
  /// What the last `advance` flew in phase cover, cut at waypoints.
  const std::vector<Stretch>& covered() const { return covered_; }
  /// Units per second from the charger's plug; 0 when not docked, and when the charger is silent for
  /// kPlugSilence_s.
  double charge_rate() const;

 private:
  struct Flight {
    std::uint32_t revision = 0;
    std::uint32_t coverage_revision = 0;
    data::PathVerdict verdict = data::PathVerdict::kCertified;
    planner::TimedPath path;
    std::size_t passed = 0;  ///< waypoints behind the aircraft
  };
  struct LegEnd {
    data::LegKind kind = data::LegKind::kCover;
    Vec3 exit_m = Vec3::Zero();
  };

  Vec3 predicted_position_m(double time_s) const;
  void pass_waypoints(Flight& flight, double until_s);
  void note_covered(const Flight& flight, double from_s, double to_s);
  bool ends_leg(const Flight& flight, std::size_t index) const;
  void fly(const Flight& flight, double to_s);
  void rest(double to_s);
  void ride(double duration_s);

  const std::uint32_t vehicle_id_;
  const planner::Terrain terrain_;
  Motion motion_;
  std::vector<Stretch> covered_;
  std::vector<Motion> corners_;
  std::optional<Flight> flight_;
  std::deque<Flight> next_;  ///< accepted, not begun; in order of their begin
  std::optional<std::uint32_t> last_offered_;
  std::map<std::uint32_t, std::vector<LegEnd>> leg_ends_;  ///< by revision of the CoveragePlan
  std::optional<data::ChargerState> charger_;
};

}  // namespace swallowtail::sim
