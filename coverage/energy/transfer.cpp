#include "coverage/energy/transfer.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::coverage {
namespace {

constexpr double kSameSite_m = 1e-3;
constexpr double kRounding = 1e-9;

std::optional<Vec3> direction_or_none(const FlownLeg& leg) {
  const Vec3 d = leg.direction();
  if (d.squaredNorm() < kSameSite_m * kSameSite_m) return std::nullopt;
  return d;
}

/// Lands with `arrives`, is charged to `needs`, takes off again.
std::optional<TransferChoice> charge_stop(double arrives, double needs, double flight_s,
                                          const TransferTerms& terms) {
  if (arrives < terms.reserve - kRounding || needs > terms.capacity + kRounding) return std::nullopt;
  const double charged = std::max(0.0, needs - arrives);
  return TransferChoice{
      Transfer::kFF, flight_s + terms.landing_s + terms.charging.seconds(arrives, needs) + terms.take_off_s,
      charged};
}

std::optional<TransferChoice> fly_both(const LegLink& link, double exit, double entry,
                                       const TransferTerms& t) {
  const double between = t.reserve + link.ground_to_ground.energy * t.energy_factor;
  const double arrives = exit - link.land_at_exit.energy * t.energy_factor;
  const auto first =
      charge_stop(arrives, between, link.land_at_exit.time_s + link.ground_to_ground.time_s, t);
  if (!first) return std::nullopt;
  const double lands = std::max(between, arrives) - link.ground_to_ground.energy * t.energy_factor;
  const auto second =
      charge_stop(lands, entry + link.lift_at_entry.energy * t.energy_factor, link.lift_at_entry.time_s, t);
  if (!second) return std::nullopt;
  return TransferChoice{Transfer::kFDUFDU, first->time_s + second->time_s, first->charged + second->charged};
}

std::optional<TransferChoice> be_carried(const LegLink& link, double exit, double entry,
                                         const TransferTerms& t) {
  if (link.same_site) return std::nullopt;
  const double arrives = exit - link.land_at_exit.energy * t.energy_factor;
  const double needs = entry + link.lift_at_entry.energy * t.energy_factor;
  if (arrives < t.reserve - kRounding || needs > t.capacity + kRounding) return std::nullopt;
  const double charged = std::max(0.0, needs - arrives);
  const double on_board = std::max(link.drive_s, t.charging.seconds(arrives, needs));
  return TransferChoice{
      Transfer::kFDTU,
      link.land_at_exit.time_s + t.landing_s + on_board + t.take_off_s + link.lift_at_entry.time_s, charged};
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

std::optional<TransferChoice> try_transfer(Transfer type, const LegLink& link, double energy_at_exit,
                                           double energy_at_entry, const TransferTerms& t) {
  std::optional<TransferChoice> out;
  const bool at_exit = type == Transfer::kFDUF || type == Transfer::kFDUFDU || type == Transfer::kFDTU;
  const bool at_entry = type == Transfer::kFFDU || type == Transfer::kFDUFDU;
  if ((at_exit && !link.meets_at_exit) || (at_entry && !link.meets_at_entry)) return out;
  switch (type) {
    case Transfer::kFF:
      if (energy_at_exit - link.hop.energy * t.energy_factor >= energy_at_entry - kRounding)
        out = TransferChoice{type, link.hop.time_s, 0.0};
      break;
    case Transfer::kFFDU:
      out = charge_stop(energy_at_exit - link.land_at_entry.energy * t.energy_factor,
                        energy_at_entry + link.lift_at_entry.energy * t.energy_factor,
                        link.land_at_entry.time_s + link.lift_at_entry.time_s, t);
      break;
    case Transfer::kFDUF:
      out = charge_stop(energy_at_exit - link.land_at_exit.energy * t.energy_factor,
                        energy_at_entry + link.lift_from_exit.energy * t.energy_factor,
                        link.land_at_exit.time_s + link.lift_from_exit.time_s, t);
      break;
    case Transfer::kFDUFDU:
      out = fly_both(link, energy_at_exit, energy_at_entry, t);
      break;
    case Transfer::kFDTU:
      out = be_carried(link, energy_at_exit, energy_at_entry, t);
      break;
    case Transfer::kEnd:
      break;
  }
  if (out) out->type = type;
  return out;
}

std::optional<TransferChoice> best_transfer(const LegLink& link, double energy_at_exit,
                                            double energy_at_entry, const TransferTerms& terms) {
  std::optional<TransferChoice> best;
  for (const Transfer type :
       {Transfer::kFF, Transfer::kFFDU, Transfer::kFDUF, Transfer::kFDUFDU, Transfer::kFDTU}) {
    const auto choice = try_transfer(type, link, energy_at_exit, energy_at_entry, terms);
    if (choice && (!best || choice->time_s < best->time_s - 1e-12)) best = choice;
  }
  return best;
}

}  // namespace swallowtail::coverage
