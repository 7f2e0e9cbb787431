#include "coverage/energy/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::coverage {
namespace {

constexpr double kSameSite_m = 1e-3;
constexpr double kRounding = 1e-9;
/// Times so near are the same: the first type is taken.
constexpr double kSame_s = 1e-12;
constexpr double kNever_s = std::numeric_limits<double>::infinity();

std::optional<Vec3> direction_or_none(const FlownLeg& leg) {
  const Vec3 d = leg.direction();
  if (d.squaredNorm() < kSameSite_m * kSameSite_m) return std::nullopt;
  return d;
}

}  // namespace

const char* name_of(Transfer transfer) {
  constexpr std::array kNames = {"F-F", "F-FDU", "F-DUF", "F-DUFDU", "F-DTU", "END"};
  return kNames[static_cast<std::size_t>(transfer)];
}

LegLink link_legs(const FlownLeg& from, const FlownLeg& to, const FlightModel& model,
                  const Charger& charger) {
  LegLink out;
  const auto before = direction_or_none(from);
  const auto after = direction_or_none(to);
  out.hop = model.transfer(from.exit_m, to.entry_m, {before, after});
  out.land_at_exit = model.landing(from.exit_m);
  out.land_at_entry = model.transfer_and_land(from.exit_m, before, to.entry_m);
  out.lift_from_exit = model.take_off_to(from.exit_m, to.entry_m, after);
  out.lift_at_entry = model.take_off(to.entry_m);
  out.ground_to_ground = model.take_off_to(from.exit_m, to.entry_m, std::nullopt) + model.landing(to.entry_m);
  const double distance = (to.entry_m.head<2>() - from.exit_m.head<2>()).norm();
  out.drive_s = drive_s(charger, from.exit_m, to.entry_m);
  out.same_site = distance < kSameSite_m || !std::isfinite(out.drive_s);
  out.meets_at_exit = std::isfinite(drive_s(charger, charger.start_m, from.exit_m));
  out.meets_at_entry = std::isfinite(drive_s(charger, charger.start_m, to.entry_m));
  return out;
}

TransferOptions::TransferOptions(const LegLink& link, double energy_at_exit, const TransferTerms& terms)
    : terms_(terms), is_linear_(terms.charging.is_linear()) {
  const double factor = terms.energy_factor;
  flown_on_ = energy_at_exit - link.hop.energy * factor;
  hop_s_ = link.hop.time_s;
  const double lift_at_entry = link.lift_at_entry.energy * factor;
  const double lands_at_exit = energy_at_exit - link.land_at_exit.energy * factor;
  if (link.meets_at_entry) {
    add({Transfer::kFFDU, energy_at_exit - link.land_at_entry.energy * factor, lift_at_entry, 0.0,
         link.land_at_entry.time_s + link.lift_at_entry.time_s + terms.landing_s, 0.0, terms.take_off_s});
  }
  if (!link.meets_at_exit) return;
  add({Transfer::kFDUF, lands_at_exit, link.lift_from_exit.energy * factor, 0.0,
       link.land_at_exit.time_s + link.lift_from_exit.time_s + terms.landing_s, 0.0, terms.take_off_s});
  if (link.meets_at_entry) add_fly_both(link, lands_at_exit);
  if (link.same_site) return;
  add({Transfer::kFDTU, lands_at_exit, lift_at_entry, 0.0, link.land_at_exit.time_s + terms.landing_s,
       link.drive_s, terms.take_off_s + link.lift_at_entry.time_s});
}

void TransferOptions::add(const Stop& stop) {
  if (stop.arrives >= terms_.reserve - kRounding) stops_[count_++] = stop;
}

/// Charged at the exit just for the flight to the entry, and there for what follows.
void TransferOptions::add_fly_both(const LegLink& link, double lands) {
  const double factor = terms_.energy_factor;
  const double between = link.ground_to_ground.energy * factor;
  const double needs = terms_.reserve + between;
  if (lands < terms_.reserve - kRounding || needs > terms_.capacity + kRounding) return;
  const double handling_s = terms_.landing_s + terms_.take_off_s;
  add({Transfer::kFDUFDU, std::max(needs, lands) - between, link.lift_at_entry.energy * factor,
       std::max(0.0, needs - lands),
       link.land_at_exit.time_s + link.ground_to_ground.time_s + handling_s +
           terms_.charging.seconds(lands, needs) + link.lift_at_entry.time_s + terms_.landing_s,
       0.0, terms_.take_off_s});
}

/// Infinite when it asks for more than a full battery.
double TransferOptions::time_s(const Stop& stop, double energy_at_entry) const {
  const double needs = energy_at_entry + stop.lift;
  if (needs > terms_.capacity + kRounding) return kNever_s;
  const double charging_s = is_linear_ ? (needs - stop.arrives) * terms_.charging.s_per_unit
                                       : terms_.charging.seconds(stop.arrives, needs);
  return stop.before_s + std::max(stop.least_s, charging_s) + stop.after_s;
}

TransferChoice TransferOptions::choice(const Stop& stop, double energy_at_entry) const {
  return {stop.type, time_s(stop, energy_at_entry),
          stop.charged + std::max(0.0, energy_at_entry + stop.lift - stop.arrives)};
}

std::optional<TransferChoice> TransferOptions::of(Transfer type, double energy_at_entry) const {
  if (type == Transfer::kFF && flown_on_ >= energy_at_entry - kRounding)
    return TransferChoice{type, hop_s_, 0.0};
  for (std::size_t i = 0; i < count_; ++i) {
    if (stops_[i].type == type && time_s(stops_[i], energy_at_entry) < kNever_s)
      return choice(stops_[i], energy_at_entry);
  }
  return std::nullopt;
}

std::optional<TransferChoice> TransferOptions::quickest(double energy_at_entry) const {
  std::optional<TransferChoice> best = of(Transfer::kFF, energy_at_entry);
  for (std::size_t i = 0; i < count_; ++i) {
    const double next_s = time_s(stops_[i], energy_at_entry);
    if (next_s < (best ? best->time_s - kSame_s : kNever_s)) best = choice(stops_[i], energy_at_entry);
  }
  return best;
}

double TransferOptions::least_s(double energy_at_entry) const {
  double least = flown_on_ >= energy_at_entry - kRounding ? hop_s_ : kNever_s;
  for (std::size_t i = 0; i < count_; ++i) least = std::min(least, time_s(stops_[i], energy_at_entry));
  return least;
}

}  // namespace swallowtail::coverage
