#include "coverage/schedule/stops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::coverage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-9;

double ground_distance(const Vec3& a, const Vec3& b) { return (a - b).head<2>().norm(); }

}  // namespace

const LegLink& LinkCache::get(std::uint32_t from_id, const FlownLeg& from, std::uint32_t to_id,
                              const FlownLeg& to) {
  const std::uint64_t key = (static_cast<std::uint64_t>(from_id) << 32) | to_id;
  const auto found = links_.find(key);
  if (found != links_.end()) return found->second;
  return links_.emplace(key, link_legs(from, to, model_, charger_)).first->second;
}

FlightCost lift_to_first(const FlightModel& model, const ScheduleStart& start, const FlownLeg& first) {
  std::optional<Vec3> along;
  if (first.direction().norm() > 1e-3) along = first.direction();
  if (start.kind == StartKind::kAir)
    return model.transfer(start.position_m, first.entry_m, {start.direction, along});
  return ground_distance(start.position_m, first.entry_m) < 1e-3
             ? model.take_off(first.entry_m)
             : model.take_off_to(start.position_m, first.entry_m, along);
}

/// Docked at a node: charging may begin at time_s with energy.
struct StopPlanner::Label {
  double time_s = 0.0;
  double energy = 0.0;
  int parent = -1;
  int node = 0;
  bool carried = false;
  // the flight that led here
  double take_off_s = 0.0;
  double energy_at_take_off = 0.0;
  double land_s = 0.0;
  double energy_on_landing = 0.0;
  double robot_arrives_s = 0.0;
  FlightCost flight;
};

/// Nodes: 0 the start, 2i+1 the exit of leg i, 2i+2 the entry of leg i+1. The exit of the last leg is the
/// end.
struct StopPlanner::Search {
  std::span<const RouteLeg> legs;
  const ScheduleStart* start = nullptr;
  const StopParams* params = nullptr;
  std::vector<const LegLink*> links;  // i → i+1
  std::vector<FlightCost> cover;
  std::vector<FlightCost> before;   // covers and hops before entry i, from entry 0, but barred ones
  std::vector<int> barred;          // hops before entry i
  std::vector<double> time_left;    // at least, from entry i to the end
  std::vector<double> price_left;   // at least, with the energy bought at the charging rate
  std::vector<double> energy_left;  // at least
  double landing_time_s = 0.0;      // one landing in between adds at least so much to time_left
  double landing_price = 0.0;       // and to price_left
  double cutoff_s = kInfinity;
  ChargingCurve charging;
  FlightCost start_lift;
  FlightCost end_landing;
  std::vector<Label> labels;
  std::vector<std::vector<int>> at;
  int best = -1;

  std::size_t size() const { return legs.size(); }
  int end_node() const { return 2 * static_cast<int>(size()) - 1; }
  std::size_t next_leg(int node) const { return node == 0 ? 0 : static_cast<std::size_t>((node + 1) / 2); }
  Vec3 site(int node) const {
    if (node == 0) return start->position_m;
    return node % 2 == 1 ? legs[static_cast<std::size_t>(node / 2)].flown.exit_m
                         : legs[static_cast<std::size_t>(node / 2)].flown.entry_m;
  }
  FlightCost lift(int node) const {
    if (node == 0) return start_lift;
    return node % 2 == 1 ? links[static_cast<std::size_t>(node / 2)]->lift_from_exit
                         : links[static_cast<std::size_t>(node / 2) - 1]->lift_at_entry;
  }
  /// Entry of `first` to exit of `last`, flown.
  FlightCost through(std::size_t first, std::size_t last) const {
    return barred[first] == barred[last] ? before[last] + cover[last] - before[first] : kBarred;
  }

  void prepare(LinkCache& cache);
  void bound_rest();
  /// No schedule through here ends earlier.
  double least_end(double time_s, double energy, std::size_t next) const {
    if (next >= size()) return time_s;
    const Battery& battery = params->battery;
    const double room = (battery.capacity - battery.reserve) / params->energy_factor;
    const double landings = std::max(0.0, std::ceil(energy_left[next] / room - 1e-9) - 1.0);
    return time_s + std::max(time_left[next] + landings * landing_time_s,
                             price_left[next] + landings * landing_price -
                                 battery.charge_s_per_unit * (energy - battery.reserve));
  }
  void add(const Label& label);
  bool fly(int from, const FlightCost& flight, int to);
  void expand(int label);
  void carry(int label);
};

void StopPlanner::Search::prepare(LinkCache& cache) {
  const FlightModel& model = cache.model();
  for (std::size_t i = 0; i < size(); ++i) {
    cover.push_back(model.level(legs[i].flown.entry_m, legs[i].flown.exit_m));
    const bool is_barred = i > 0 && links[i - 1]->hop.energy >= kBarred.energy;
    barred.push_back(i == 0 ? 0 : barred[i - 1] + (is_barred ? 1 : 0));
    before.push_back(i == 0 ? FlightCost{} : before[i - 1] + cover[i - 1]);
    if (i > 0 && !is_barred) before[i] += links[i - 1]->hop;
    if (i + 1 < size())
      links.push_back(&cache.get(legs[i].id, legs[i].flown, legs[i + 1].id, legs[i + 1].flown));
  }
  start_lift = lift_to_first(model, *start, legs.front().flown);
  end_landing = model.landing(legs.back().flown.exit_m);
  at.resize(2 * size() + 1);
  bound_rest();
}

/// Each leg is flown; between legs the aircraft flies, or at the least lands, is carried and takes off.
void StopPlanner::Search::bound_rest() {
  const double price = params->battery.charge_s_per_unit;
  const double handling = params->charger.landing_s + params->charger.take_off_s + params->lead_s;
  const auto priced = [&](const FlightCost& c) { return c.time_s + price * c.energy; };
  time_left.resize(size());
  price_left.resize(size());
  energy_left.resize(size());
  landing_time_s = size() > 1 ? kInfinity : 0.0;
  landing_price = landing_time_s;
  for (std::size_t i = size(); i-- > 0;) {
    const FlightCost flight = i + 1 < size() ? cover[i] : cover[i] + end_landing;
    time_left[i] = flight.time_s;
    price_left[i] = priced(flight);
    energy_left[i] = flight.energy;
    if (i + 1 == size()) continue;
    const LegLink& link = *links[i];
    const FlightCost at_exit = link.land_at_exit + link.lift_from_exit;
    const FlightCost at_entry = link.land_at_entry + link.lift_at_entry;
    const FlightCost carried = link.same_site ? at_exit : link.land_at_exit + link.lift_at_entry;
    const auto least = [&](auto of) { return std::min({of(at_exit), of(at_entry), of(carried)}) + handling; };
    const double landed_time = least([](const FlightCost& c) { return c.time_s; });
    const double landed_price = least(priced);
    const double time = std::min(link.hop.time_s, landed_time);
    const double cost = std::min(priced(link.hop), landed_price);
    landing_time_s = std::min(landing_time_s, landed_time - time);
    landing_price = std::min(landing_price, landed_price - cost);
    time_left[i] += time_left[i + 1] + time;
    price_left[i] += price_left[i + 1] + cost;
    energy_left[i] +=
        energy_left[i + 1] + std::min({link.hop.energy, at_exit.energy, at_entry.energy, carried.energy});
  }
}

void StopPlanner::Search::add(const Label& label) {
  if (label.node == end_node()) {
    labels.push_back(label);
    const int id = static_cast<int>(labels.size()) - 1;
    if (best < 0 || label.time_s < labels[static_cast<std::size_t>(best)].time_s - kRounding) best = id;
    cutoff_s = std::min(cutoff_s, label.time_s);
    return;
  }
  // Charged to the other's energy, it is there no later; and charging is never quicker with more held.
  const auto beats = [&](const Label& a, const Label& b) {
    return a.time_s + charging.seconds(a.energy, b.energy) <= b.time_s + kRounding;
  };
  std::vector<int>& here = at[static_cast<std::size_t>(label.node)];
  for (const int other : here) {
    if (beats(labels[static_cast<std::size_t>(other)], label)) return;
  }
  std::erase_if(here, [&](int other) { return beats(label, labels[static_cast<std::size_t>(other)]); });
  labels.push_back(label);
  here.push_back(static_cast<int>(labels.size()) - 1);
}

/// Charges what the flight needs, flies, lands, docks. False when even a full battery does not do.
bool StopPlanner::Search::fly(int from, const FlightCost& flight, int to) {
  const Label& label = labels[static_cast<std::size_t>(from)];
  const Battery& battery = params->battery;
  const Charger& charger = params->charger;
  const bool at_start = label.node == 0;
  const bool can_charge = !at_start || start->kind == StartKind::kDocked;
  const bool ends = to == end_node();
  const Vec3 robot_from = at_start && start->kind != StartKind::kDocked ? start->robot_m : site(label.node);
  const double drive = drive_s(charger, robot_from, site(to));
  if (!ends && !std::isfinite(drive)) return false;
  const bool robot_free = at_start && start->kind != StartKind::kDocked;
  const double slack = robot_free ? start->robot_free_s - label.time_s : 0.0;
  const double wait = ends ? 0.0 : std::max(0.0, drive + slack - flight.time_s);
  const double grounded = battery.model.landed_per_s * (ends ? 0.0 : wait + charger.landing_s);
  const bool under_way = at_start && start->kind == StartKind::kAir && params->air_factor > 0.0;
  const double allowance =
      under_way ? flight.energy * params->air_factor : flight.energy * params->energy_factor + params->spare;
  const double needs = battery.reserve + allowance + grounded;
  if (needs > battery.capacity + kRounding) return false;
  if (!can_charge && needs > label.energy + kRounding) return false;
  Label next;
  next.energy_at_take_off = std::max(label.energy, needs);
  const double charging_s = charging.seconds(label.energy, next.energy_at_take_off);
  next.take_off_s = label.time_s + (can_charge ? charging_s + charger.take_off_s + params->lead_s : 0.0);
  next.land_s = next.take_off_s + flight.time_s;
  next.energy_on_landing = next.energy_at_take_off - flight.energy;
  next.robot_arrives_s = robot_free ? start->robot_free_s + drive : next.take_off_s + drive;
  next.time_s = ends ? next.land_s : std::max(next.land_s, next.robot_arrives_s) + charger.landing_s;
  next.energy = next.energy_on_landing - grounded;
  if (least_end(next.time_s, next.energy, next_leg(to)) >= cutoff_s) return true;
  next.parent = from;
  next.node = to;
  next.flight = flight;
  add(next);
  return true;
}

void StopPlanner::Search::carry(int id) {
  const Label& label = labels[static_cast<std::size_t>(id)];
  const auto leg = static_cast<std::size_t>(label.node / 2);
  if (links[leg]->same_site || label.carried) return;
  const double drive = links[leg]->drive_s;
  Label next = label;
  next.carried = true;
  next.parent = id;
  next.node = label.node + 1;
  next.time_s = label.time_s + drive;
  next.energy = charging.energy_after(label.energy, drive);
  add(next);
}

void StopPlanner::Search::expand(int id) {
  const int node = labels[static_cast<std::size_t>(id)].node;
  const std::size_t first = next_leg(node);
  const FlightCost up = lift(node);
  if (node % 2 == 1) {
    carry(id);
    fly(id, links[static_cast<std::size_t>(node / 2)]->ground_to_ground, node + 1);
  }
  const double most = params->battery.capacity - params->battery.reserve;
  for (std::size_t last = first; last < size(); ++last) {
    const FlightCost flown = up + through(first, last);
    if (flown.energy > most) break;
    if (labels[static_cast<std::size_t>(id)].time_s + flown.time_s >= cutoff_s) break;
    const int exit_node = 2 * static_cast<int>(last) + 1;
    fly(id, flown + (last + 1 < size() ? links[last]->land_at_exit : end_landing), exit_node);
    if (last + 1 < size()) fly(id, flown + links[last]->land_at_entry, exit_node + 1);
  }
}

void StopPlanner::run(std::span<const RouteLeg> legs, const ScheduleStart& start, Search& search) {
  search.legs = legs;
  search.start = &start;
  search.params = &params_;
  search.charging = params_.battery.charging();
  search.prepare(*links_);
  Label first;
  first.time_s = start.time_s;
  first.energy = start.energy;
  search.add(first);
  for (int node = 0; node < search.end_node(); ++node) {
    const std::vector<int> here = search.at[static_cast<std::size_t>(node)];
    for (const int id : here) {
      const Label& label = search.labels[static_cast<std::size_t>(id)];
      if (search.least_end(label.time_s, label.energy, search.next_leg(node)) < search.cutoff_s)
        search.expand(id);
    }
  }
}

double StopPlanner::end_of(std::span<const RouteLeg> legs, const ScheduleStart& start, double cutoff_s) {
  if (legs.empty()) return start.time_s;
  Search search;
  search.cutoff_s = cutoff_s;
  run(legs, start, search);
  return search.best < 0 ? kInfinity : search.labels[static_cast<std::size_t>(search.best)].time_s;
}

std::optional<StopPlan> StopPlanner::plan(std::span<const RouteLeg> legs, const ScheduleStart& start) {
  if (legs.empty()) return std::nullopt;
  Search search;
  run(legs, start, search);
  if (search.best < 0) return std::nullopt;
  std::vector<int> chain;
  for (int id = search.best; id >= 0; id = search.labels[static_cast<std::size_t>(id)].parent)
    chain.push_back(id);
  std::reverse(chain.begin(), chain.end());
  const auto site_of = [](int node) {
    if (node == 0) return Site{};
    return node % 2 == 1 ? Site{Site::Kind::kExit, static_cast<std::size_t>(node / 2)}
                         : Site{Site::Kind::kEntry, static_cast<std::size_t>(node / 2)};
  };
  StopPlan out;
  std::optional<Recharge> pending;
  if (start.kind == StartKind::kDocked)
    pending = Recharge{Site{},       std::nullopt, start.time_s, start.time_s,
                       start.energy, start.energy, start.time_s, 0.0};
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const Label& label = search.labels[static_cast<std::size_t>(chain[i])];
    const Label& parent = search.labels[static_cast<std::size_t>(chain[i - 1])];
    if (label.carried && pending) {
      pending->carried_to = site_of(label.node);
      continue;
    }
    if (pending) {
      pending->energy_to = label.energy_at_take_off;
      pending->ready_s = label.take_off_s - params_.lead_s;
      if (out.sorties.empty()) {
        out.first = pending;
      } else {
        out.recharges.push_back(*pending);
      }
    }
    const std::size_t first = search.next_leg(parent.node);
    const std::size_t past = search.next_leg(label.node);
    out.sorties.push_back({site_of(parent.node), site_of(label.node), first, past - first, label.take_off_s,
                           label.energy_at_take_off, label.land_s, label.energy_on_landing, label.flight});
    pending = Recharge{site_of(label.node),
                       std::nullopt,
                       label.robot_arrives_s,
                       label.time_s,
                       label.energy,
                       label.energy,
                       0.0,
                       std::max(0.0, label.robot_arrives_s - label.land_s)};
  }
  out.end_s = search.labels[static_cast<std::size_t>(search.best)].time_s;
  return out;
}

}  // namespace swallowtail::coverage
