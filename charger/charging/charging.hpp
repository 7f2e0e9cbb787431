#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "charger/charging/own_battery.hpp"
#include "charger/motion/drive.hpp"
#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

/// What a ground robot does with its orders: drive to where the vehicle will land, take it on board, charge
/// it, carry it if asked, let it go, drive on, and fetch new energy at its depot. No clock, no middleware.
namespace swallowtail::charger {

/// A way with its bends (Drive::follow), and how fast it is driven; 0: at the orders' speed.
struct Way {
  std::vector<Vec3> bends_m{};
  double speed_mps = 0.0;
};

/// One meeting with the vehicle, or a stop at the depot with the id of the meeting after it. Ids grow along
/// the plan: 2·i at the entry of leg i, 2·i + 1 at its exit.
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
  bool is_depot = false;
  Way home{};         ///< to the depot, from where it is when the meeting is over
  double uses = 0.0;  ///< of its own battery, from its arrival until the meeting is over, as planned
  /// When the vehicle was to be there; infinite: not said.
  double arrive_by_s = std::numeric_limits<double>::infinity();
};

struct Orders {
  std::uint32_t revision = 0;
  double speed_mps = 1.0;
  double charge_s_per_unit = 1.0;
  double taper_from = 1.0;  ///< share of the battery's capacity where charging begins to slow down; 1: never
  double taper_end_rate = 0.1;             ///< share of the rate that is left when it is full
  double landing_s = 0.0;                  ///< handling after the vehicle has landed
  double take_off_s = 0.0;                 ///< handling before it may leave
  Vec3 start_m = Vec3::Zero();             ///< its depot
  std::vector<Meeting> meetings;           ///< those ahead, in order
  std::optional<BatteryLimits> battery{};  ///< its own; none: its energy has no end
  Way home{};                              ///< from where it is
};
/// Speed and charging time positive, handling times not negative, the taper within 0 … 1, its own battery
/// sound, everything finite.
Status validate(const Orders& orders);

/// The robot does not drive from at_s until at_s + duration_s.
struct Delay {
  double at_s = 0.0;
  double duration_s = 0.0;
};

/// Energy that its own battery loses at once.
struct Loss {
  double at_s = 0.0;
  double energy = 0.0;
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

enum class Activity : std::uint8_t {
  kIdle,
  kDriving,
  kWaiting,
  kCharging,
  kCarrying,
  kReady,
  kDelayed,
  kRefilling
};

/// Whoever was not stepped for longer stood still and charged nothing since.
inline constexpr double kLongestStep_s = 5.0;
/// How near to the robot a landed vehicle must stand to be taken on board.
inline constexpr double kDocking_m = 1.0;
/// One that stands where it was to be by so long ago has flown there unseen.
inline constexpr double kOverdue_s = 60.0;
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
  double energy = 0.0;  ///< its own; 0 where it is not limited
};

/// The robot. Every step looks at the newest orders, so that a meeting that moves, changes or vanishes is
/// followed at once; a vehicle on board is served to the end even if its meeting has vanished.
/// - The next meeting is the first one ahead, unless the vehicle stands on the ground at another one.
/// - With the vehicle on board: `landing_s` of handling, charging up to `charge_to` (and carrying meanwhile),
/// `take_off_s` of handling, READY until it flies.
/// - A robot that starts late takes on where the vehicle says it is on board, and is taken to be full.
/// - With a battery of its own it stops at its depot where the orders say so, and also when it is about to
/// set out (after a meeting, or by new orders) with less than the next meeting and the way home from there
/// take. On board too the vehicle is only given what leaves enough for the way home; where that does not do,
/// the robot takes it along to the depot and back. Its reserve is kept by that, but for losses.
class Charging {
 public:
  /// The robot stands at `orders.start_m` at mission time `time_s`. Errors: see validate(Orders).
  static Result<Charging> make(Orders orders, std::vector<Delay> delays, double time_s = 0.0,
                               std::vector<Loss> losses = {});

  /// Takes effect with the next step. Errors leave the old orders in force.
  Status set_orders(Orders orders);

  /// Goes on to mission time `time_s`; a time before the last one changes nothing. At most one change of
  /// activity that waits for nothing else happens per call, and no more than kLongestStep_s of driving and
  /// charging.
  const State& step(double time_s, const Inputs& inputs);

  const State& state() const { return state_; }

 private:
  enum class Service : std::uint8_t { kNone, kLanding, kServing, kTakeOff, kReady };

  /// How much this robot had delivered in all at a time.
  struct Delivery {
    double time_s = 0.0;
    double energy = 0.0;
  };

  Charging(Orders orders, std::vector<Delay> delays, double time_s, std::vector<Loss> losses);

  const Meeting* next_meeting(const Inputs& inputs) const;
  bool is_behind(const Meeting& meeting, const Inputs& inputs) const;
  bool has_left(const Inputs& inputs) const;
  bool waits_for_us(const Meeting& meeting, const Inputs& inputs) const;
  bool is_delayed() const;
  double energy_now(const Inputs& inputs) const;
  double missing_energy(const Inputs& inputs) const;
  void approach(const Inputs& inputs, double duration_s);
  void drive(const Way& way, const Vec3& target_m, double duration_s);
  double speed_on(const Way& way) const;
  double way_s(const Way& way, double length_m) const;
  double for_the_way_home(const Meeting& meeting) const;
  double needs(const Meeting& meeting) const;
  bool must_fetch_before(const Meeting& meeting) const;
  bool has_an_errand(const Meeting& next);
  void fetch(const Way& way, double duration_s);
  void begin_errand_on_board(const Inputs& inputs);
  void run_errand_on_board(double duration_s);
  void refill_when_due();
  void suffer_losses();
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

  /// To its depot on its own account, or there, or (with the vehicle on board) back.
  enum class Errand : std::uint8_t { kNone, kToDepot, kRefilling, kBack };
  OwnBattery own_;
  std::vector<Loss> losses_;
  Errand errand_ = Errand::kNone;
  bool sets_out_anew_ = true;  ///< what it drives to next is not decided
  double refilled_s_ = 0.0;    ///< when the refill under way is over
  Vec3 errand_from_m_ = Vec3::Zero();
  std::optional<std::uint32_t> depot_done_;  ///< id of the last stop at the depot that was kept
  Way home_;                                 ///< from where it was when its last meeting or plan ended
};

}  // namespace swallowtail::charger
