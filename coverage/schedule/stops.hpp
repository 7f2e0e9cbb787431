#pragma once

#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "coverage/energy/transfer.hpp"

namespace swallowtail::coverage {

enum class StartKind : std::uint8_t {
  kGround,  ///< landed, may take off at once, no robot there
  kDocked,  ///< on the robot and ready to be charged
  kAir,
};

/// Where aircraft and robot are when a schedule begins.
struct ScheduleStart {
  StartKind kind = StartKind::kGround;
  Vec3 position_m = Vec3::Zero();
  std::optional<Vec3> direction;  ///< flown at the moment, in the air only
  double time_s = 0.0;            ///< of the aircraft; docked: when charging may begin
  double energy = 0.0;
  Vec3 robot_m = Vec3::Zero();
  double robot_free_s =
      0.0;  ///< when the robot may leave robot_m; docked: unused, it leaves when the aircraft does
};

struct StopParams {
  Battery battery;
  Charger charger;
  double energy_factor =
      1.08;  ///< a flight is begun only with so many times what it should take: allowance for wind and noise
  double spare = 0.0;  ///< energy kept besides, for flights too short for a share to mean anything
  double air_factor =
      0.0;  ///< instead of energy_factor, and without the spare, for a flight already under way; 0: the same
  double lead_s = 1.0;  ///< from ready until the aircraft leaves the ground
};

/// A place on the ground where the aircraft meets the robot, or begins.
struct Site {
  enum class Kind : std::uint8_t { kStart, kExit, kEntry };
  Kind kind = Kind::kStart;
  std::size_t leg = 0;  ///< whose exit or entry it is
};

/// From a take-off (or from the start in the air) to the next landing.
struct Sortie {
  Site from;
  Site to;
  std::size_t first_leg = 0;
  std::size_t leg_count = 0;  ///< may be 0: from an exit to the next entry
  double take_off_s = 0.0;
  double energy_at_take_off = 0.0;
  double land_s = 0.0;
  double energy_on_landing = 0.0;
  FlightCost flight;
};

/// On the robot after sortie k: docked, charged, perhaps carried, ready.
struct Recharge {
  Site at;
  std::optional<Site> carried_to;
  double robot_arrives_s = 0.0;
  double dock_s = 0.0;  ///< charging begins
  double energy_from = 0.0;
  double energy_to = 0.0;
  double ready_s = 0.0;
  double wait_s = 0.0;  ///< landed, waiting for the robot
};

struct StopPlan {
  std::optional<Recharge> first;  ///< before the first sortie, when it starts docked
  std::vector<Sortie> sorties;
  std::vector<Recharge> recharges;  ///< one fewer than sorties
  double end_s = 0.0;               ///< landed for good
};

/// Links between directed legs, computed once each. Key: caller's leg ids.
class LinkCache {
 public:
  LinkCache(const FlightModel& model, const Charger& charger) : model_(model), charger_(charger) {}
  const LegLink& get(std::uint32_t from_id, const FlownLeg& from, std::uint32_t to_id, const FlownLeg& to);
  const FlightModel& model() const { return model_; }
  const Charger& charger() const { return charger_; }

 private:
  FlightModel model_;
  Charger charger_;
  std::unordered_map<std::uint64_t, LegLink> links_;
};

/// A leg of a route with its id in the cache (unique per sub-cell and direction).
struct RouteLeg {
  std::uint32_t id = 0;
  FlownLeg flown;
};

/// From where a schedule begins to the entry of its first leg.
FlightCost lift_to_first(const FlightModel& model, const ScheduleStart& start, const FlownLeg& first);

/// Decides, for legs in a given order, where to land, charge and be carried, and how much to charge, so that
/// the last landing is earliest: exact by labels over the possible landings (time against energy, energy
/// priced by the charging curve; since that is never quicker with more energy held, charging is put off until
/// a flight needs it), battery continuous. The robot drives from rendezvous to rendezvous; if it is
/// late the aircraft waits landed. Every landing is predicted to keep the reserve with energy_factor to
/// spare. Departs from [COV]: battery levels and drive times that the graph leaves out.
class StopPlanner {
 public:
  StopPlanner(LinkCache& links, const StopParams& params) : links_(&links), params_(params) {}

  /// Nothing when no such schedule exists (a leg too long for the battery; too little energy at the start).
  std::optional<StopPlan> plan(std::span<const RouteLeg> legs, const ScheduleStart& start);
  /// Its end time only, infinite when there is none that ends before `cutoff_s`. The lower the cutoff, the
  /// quicker.
  double end_of(std::span<const RouteLeg> legs, const ScheduleStart& start,
                double cutoff_s = std::numeric_limits<double>::infinity());

 private:
  struct Label;
  struct Search;
  void run(std::span<const RouteLeg> legs, const ScheduleStart& start, Search& search);

  LinkCache* links_;
  StopParams params_;
};

}  // namespace swallowtail::coverage
