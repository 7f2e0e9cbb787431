#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "coverage/energy/flight.hpp"

namespace swallowtail::coverage {

/// What happens between a leg's exit and the next leg's entry [COV Tab. 2]: F fly, D land, U take off, T be
/// carried. kEnd: land, nothing follows.
enum class Transfer : std::uint8_t { kFF, kFFDU, kFDUF, kFDUFDU, kFDTU, kEnd };
const char* name_of(Transfer transfer);

/// Flights between two legs, from which the five transfers are put together. Energies and times without
/// handling, charging and driving.
struct LegLink {
  FlightCost hop;               ///< exit → entry in the air
  FlightCost land_at_exit;      ///< exit → ground
  FlightCost land_at_entry;     ///< exit → above the entry → ground
  FlightCost lift_from_exit;    ///< ground at the exit → entry
  FlightCost lift_at_entry;     ///< ground at the entry → entry
  FlightCost ground_to_ground;  ///< ground at the exit → ground at the entry, by air
  double drive_s = 0.0;         ///< ground robot from one site to the other
  bool same_site =
      false;  ///< being carried makes no sense: exit and entry are one place, or no way joins them
  bool meets_at_exit = true;  ///< the robot can get there
  bool meets_at_entry = true;
};

/// A leg as it is flown.
struct FlownLeg {
  Vec3 entry_m = Vec3::Zero();
  Vec3 exit_m = Vec3::Zero();
  /// Of no length when entry and exit are one place.
  Vec3 direction() const { return exit_m - entry_m; }
};

LegLink link_legs(const FlownLeg& from, const FlownLeg& to, const FlightModel& model, const Charger& charger);

struct TransferTerms {
  double capacity = 500.0;
  double reserve = 25.0;
  ChargingCurve charging{};
  double take_off_s = 5.0;
  double landing_s = 5.0;
  double energy_factor = 1.0;  ///< predicted energies are multiplied by this: allowance for wind and noise
};

struct TransferChoice {
  Transfer type = Transfer::kFF;
  double time_s = 0.0;
  double charged = 0.0;
};

/// The conditions and times of [COV Tab. 2] with its printing errors corrected (see design notes: signs, `e`,
/// and the take-off of F-DUF at the exit): from `energy_at_exit` to at least some energy in the air at the
/// next leg's entry, charging only what is missing. Every landing keeps the reserve. What depends on the link
/// and the exit alone is reckoned once.
class TransferOptions {
 public:
  TransferOptions(const LegLink& link, double energy_at_exit, const TransferTerms& terms);

  /// Nothing when the type cannot do it.
  std::optional<TransferChoice> of(Transfer type, double energy_at_entry) const;
  /// The quickest of the five.
  std::optional<TransferChoice> quickest(double energy_at_entry) const;
  /// Its time alone; infinite when none can do it.
  double least_s(double energy_at_entry) const;

 private:
  /// A transfer that ends with charging and a take-off.
  struct Stop {
    Transfer type = Transfer::kFFDU;
    double arrives = 0.0;   ///< energy when that charging begins
    double lift = 0.0;      ///< energy from there to the entry
    double charged = 0.0;   ///< before
    double before_s = 0.0;  ///< until charging begins
    double least_s = 0.0;   ///< it takes no less
    double after_s = 0.0;   ///< from charged to the entry
  };
  double time_s(const Stop& stop, double energy_at_entry) const;
  TransferChoice choice(const Stop& stop, double energy_at_entry) const;
  void add(const Stop& stop);
  void add_fly_both(const LegLink& link, double lands);

  TransferTerms terms_;
  bool is_linear_ = true;
  double flown_on_ = 0.0;  ///< energy at the entry without a landing
  double hop_s_ = 0.0;
  std::array<Stop, 4> stops_;  ///< by type; those that the exit allows
  std::size_t count_ = 0;
};

}  // namespace swallowtail::coverage
