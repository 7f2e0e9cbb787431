#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "charger/motion/drive.hpp"
#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

/// What a ground robot does with its orders: drive to where the vehicle will land, take it on board, charge
/// it, carry it if asked, let it go, drive on. No clock, no middleware.
namespace swallowtail::charger {

/// One meeting with the vehicle. Ids grow along the plan: 2·i at the entry of leg i, 2·i + 1 at its exit.
struct Meeting {
  std::uint32_t id = 0;
  Vec3 site_m = Vec3::Zero();
  double charge_to = 0.0;
  std::optional<Vec3> carry_to_m;
  /// Where the ways to the site, and on to carry_to_m, bend (Drive::follow), and how fast they are driven; 0:
  /// at the orders' speed.
  std::vector<Vec3> way_m{};
  double way_speed_mps = 0.0;
  std::vector<Vec3> carry_way_m{};
  double carry_speed_mps = 0.0;
};

struct Orders {
  std::uint32_t revision = 0;
  double speed_mps = 1.0;
  double charge_s_per_unit = 1.0;
  double taper_from = 1.0;  ///< share of the battery's capacity where charging begins to slow down; 1: never
  double taper_end_rate = 0.1;  ///< share of the rate that is left when it is full
  double landing_s = 0.0;       ///< handling after the vehicle has landed
  double take_off_s = 0.0;      ///< handling before it may leave
  Vec3 start_m = Vec3::Zero();
  std::vector<Meeting> meetings;  ///< those ahead, in order
};
/// Speed and charging time positive, handling times not negative, the taper within 0 … 1, everything finite.
Status validate(const Orders& orders);

/// The robot does not drive from at_s until at_s + duration_s.
struct Delay {
  double at_s = 0.0;
  double duration_s = 0.0;
};

enum class VehicleActivity : std::uint8_t { kOnGround, kFlying };

/// The newest of what is known of the vehicle.
struct VehicleView {
  Vec3 position_m = Vec3::Zero();
  VehicleActivity activity = VehicleActivity::kOnGround;
  bool docked_here = false;  ///< the vehicle itself says that it is on board this robot
  std::uint32_t legs_done = 0;
};

struct BatteryView {
  double time_s = 0.0;
  double energy = 0.0;
  double capacity = 0.0;
};

struct Inputs {
  std::optional<VehicleView> vehicle;
  std::optional<BatteryView> battery;
};

enum class Activity : std::uint8_t { kIdle, kDriving, kWaiting, kCharging, kCarrying, kReady, kDelayed };

/// How near to the robot a landed vehicle must stand to be taken on board.
inline constexpr double kDocking_m = 1.0;
/// Charging ends this little below what was asked for, so that it never goes above.
inline constexpr double kChargeTolerance = 0.05;

struct State {
  double time_s = 0.0;
  Vec3 position_m = Vec3::Zero();
  double speed_mps = 0.0;
  bool has_vehicle = false;
  double charge_rate = 0.0;       ///< units per second from now on
  double energy_delivered = 0.0;  ///< units in all
  Activity activity = Activity::kIdle;
  std::uint32_t meeting_id = 0;  ///< the one under way
  std::uint32_t meetings_done = 0;
  std::uint32_t orders_revision = 0;
};

/// The robot. Every step looks at the newest orders, so that a meeting that moves, changes or vanishes is
/// followed at once; a vehicle on board is served to the end even if its meeting has vanished.
/// - The next meeting is the first one ahead, unless the vehicle stands on the ground at another one.
/// - With the vehicle on board: `landing_s` of handling, charging up to `charge_to` (and carrying meanwhile),
/// `take_off_s` of handling, READY until it flies.
/// - A robot that starts late takes on where the vehicle says it is on board.
class Charging {
 public:
  /// The robot stands at `orders.start_m` at mission time `time_s`. Errors: see validate(Orders).
  static Result<Charging> make(Orders orders, std::vector<Delay> delays, double time_s = 0.0);

  /// Takes effect with the next step. Errors leave the old orders in force.
  Status set_orders(Orders orders);

  /// Goes on to mission time `time_s`; a time before the last one changes nothing. At most one change of
  /// activity that waits for nothing else happens per call.
  const State& step(double time_s, const Inputs& inputs);

  const State& state() const { return state_; }

 private:
  enum class Service : std::uint8_t { kNone, kLanding, kServing, kTakeOff, kReady };

  /// How much this robot had delivered in all at a time.
  struct Delivery {
    double time_s = 0.0;
    double energy = 0.0;
  };

  Charging(Orders orders, std::vector<Delay> delays, double time_s);

  const Meeting* next_meeting(const Inputs& inputs) const;
  bool is_behind(const Meeting& meeting, const Inputs& inputs) const;
  bool has_left(const Inputs& inputs) const;
  bool waits_for_us(const Meeting& meeting, const Inputs& inputs) const;
  bool is_delayed() const;
  double energy_now(const Inputs& inputs) const;
  double missing_energy(const Inputs& inputs) const;
  void approach(const Inputs& inputs, double duration_s);
  void drive_to_site(const Meeting& meeting, double duration_s);
  void carry(double duration_s);
  bool is_held_up();
  double greatest_rate(const BatteryView& battery, double energy) const;
  void take_on_board(const Meeting& meeting);
  void adopt_vehicle(const Inputs& inputs);
  void follow_changed_meeting(const Inputs& inputs);
  void serve(const Inputs& inputs, double duration_s);
  void charge(const Inputs& inputs, double duration_s);
  void finish();
  void forget_replaced_vehicle(const Inputs& inputs);
  void account_for_delivery(const Inputs& inputs, double duration_s);

  Orders orders_;
  std::vector<Delay> delays_;
  Drive drive_;
  State state_;
  Service service_ = Service::kNone;
  Meeting current_;  ///< while service_ is not kNone
  double handling_until_s_ = 0.0;
  std::deque<Delivery> deliveries_;  ///< since the newest battery sample, and the one before it
  std::uint32_t legs_seen_ = 0;      ///< that the vehicle had done
  bool vehicle_has_flown_ = false;
  std::optional<Meeting> last_done_;
  std::uint32_t last_done_revision_ = 0;
};

}  // namespace swallowtail::charger
