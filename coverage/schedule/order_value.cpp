#include "coverage/schedule/order_value.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swallowtail::coverage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-9;

}  // namespace

const OrderValue::Step& OrderValue::step(std::size_t leg) const {
  return leg >= changed_first_ && leg < changed_past_ ? changed_[leg - changed_first_] : steps_[leg];
}

const OrderValue::Points& OrderValue::value(std::size_t node) const {
  return node >= changed_node_ && node < changed_node_past_ ? changed_values_[node - changed_node_]
                                                            : values_[node];
}

Vec2 OrderValue::site(std::size_t node) const {
  if (node == 0) return start_.position_m.head<2>();
  return node % 2 == 1 ? step(node / 2).exit_m : step(node / 2).entry_m;
}

OrderValue::Cost OrderValue::lift(std::size_t node) const {
  if (node == 0) return is_lift_changed_ ? changed_lift_ : start_lift_;
  return node % 2 == 1 ? step(node / 2).lift_at_exit : step(node / 2).lift_at_entry;
}

/// From the exit of the last leg before it.
OrderValue::Cost OrderValue::landing(std::size_t node) const {
  return node % 2 == 1 ? step(node / 2).land_at_exit : step(node / 2 - 1).land_at_next;
}

double OrderValue::drive_s(const Vec2& from, const Vec2& to) const {
  return coverage::drive_s(params_.charger, from, to);
}

/// On the robot before a flight, and after it.
double OrderValue::handling_s(std::size_t to) const {
  const Charger& charger = params_.charger;
  return charger.take_off_s + params_.lead_s + (to == end_node() ? 0.0 : charger.landing_s);
}

/// See StopPlanner::Search::fly. False when even a full battery does not do.
bool OrderValue::make_flight(std::size_t from, std::size_t to, const Cost& air, Flight& out) const {
  const Battery& battery = params_.battery;
  const bool ends = to == end_node();
  const double at_once = least_needs(air);
  if (at_once > battery.capacity + kRounding) return false;
  const double drive = ends ? 0.0 : drive_s(site(from), site(to));
  if (!std::isfinite(drive)) return false;
  const double grounded =
      ends ? 0.0
           : battery.model.landed_per_s * (std::max(0.0, drive - air.time_s) + params_.charger.landing_s);
  out.needs = at_once + grounded;
  if (out.needs > battery.capacity + kRounding) return false;
  out.consumes = air.energy + grounded;
  out.time_s = handling_s(to) + std::max(air.time_s, drive);
  return true;
}

/// From a start that is not on the robot.
bool OrderValue::first_flight(std::size_t to, const Cost& air, Point& docked) const {
  const Battery& battery = params_.battery;
  const bool ends = to == end_node();
  const double drive = ends ? 0.0 : drive_s(start_.robot_m.head<2>(), site(to));
  if (!std::isfinite(drive)) return false;
  const double robot_s = start_.robot_free_s + drive;
  const double land_s = start_.time_s + air.time_s;
  const double grounded =
      ends ? 0.0 : battery.model.landed_per_s * (std::max(0.0, robot_s - land_s) + params_.charger.landing_s);
  const bool under_way = start_.kind == StartKind::kAir && params_.air_factor > 0.0;
  const double allowance =
      under_way ? air.energy * params_.air_factor : air.energy * params_.energy_factor + params_.spare;
  const double needs = battery.reserve + allowance + grounded;
  if (needs > std::min(battery.capacity, start_.energy) + kRounding) return false;
  docked.time_s = ends ? land_s : std::max(land_s, robot_s) + params_.charger.landing_s;
  docked.energy = start_.energy - air.energy - grounded;
  return true;
}

/// take(node, cost in the air), the farthest first.
template <class Take>
void OrderValue::for_each_flight_from(std::size_t node, std::size_t least_to, const Take& take) const {
  const double most = most_flown();
  const std::size_t first = first_leg(node);
  Cost air = lift(node);
  reach_.clear();
  for (std::size_t last = first; last < legs_.size(); ++last) {
    const Step& at = step(last);
    air += at.cover;
    if (air.energy > most) break;
    reach_.push_back(air);
    air += at.hop;
  }
  flights_ += reach_.size();
  for (std::size_t last = first + reach_.size(); last-- > first;) {
    const Cost& flown = reach_[last - first];
    const std::size_t exit = 2 * last + 1;
    if (exit + 1 < least_to) return;
    if (exit < end_node()) take(exit + 1, flown + step(last).land_at_next);
    if (exit >= least_to) take(exit, flown + step(last).land_at_exit);
  }
}

/// take(node, cost in the air), of the nodes from which this one is reached, the farthest first.
template <class Take>
void OrderValue::for_each_flight_to(std::size_t node, const Take& take) const {
  const double most = most_flown();
  const std::size_t last = last_leg(node);
  const Cost down = landing(node);
  reach_.clear();
  Cost through = step(last).cover;
  for (std::size_t first = last; through.energy <= most; --first) {
    reach_.push_back(through);
    if (first == 0) break;
    through = step(first - 1).cover + step(first - 1).hop + through;
  }
  flights_ += reach_.size();
  for (std::size_t back = reach_.size(); back-- > 0;) {
    const std::size_t first = last - back;
    const Cost& flown = reach_[back];
    if (first > 0) take(2 * first - 1, lift(2 * first - 1) + flown + down);
    take(2 * first, lift(2 * first) + flown + down);
  }
}

void OrderValue::add_corner(Points& to, double time_s, double energy) const {
  const double price = params_.battery.charge_s_per_unit;
  if (energy > params_.battery.capacity) {
    time_s += price * (energy - params_.battery.capacity);
    energy = params_.battery.capacity;
  }
  for (const Point& p : to.all) {
    if (p.time_s + price * std::max(0.0, p.energy - energy) <= time_s) return;
  }
  std::erase_if(
      to.all, [&](const Point& p) { return time_s + price * std::max(0.0, energy - p.energy) <= p.time_s; });
  to.all.push_back({time_s, energy});
  to.least_time_s = std::min(to.least_time_s, time_s);
  to.least_priced_s = std::min(to.least_priced_s, time_s + price * energy);
}

void OrderValue::add_label(Points& to, double time_s, double energy) const {
  const double price = params_.battery.charge_s_per_unit;
  for (const Point& p : to.all) {
    if (p.time_s + price * std::max(0.0, energy - p.energy) <= time_s) return;
  }
  std::erase_if(
      to.all, [&](const Point& p) { return time_s + price * std::max(0.0, p.energy - energy) <= p.time_s; });
  to.all.push_back({time_s, energy});
  to.least_time_s = std::min(to.least_time_s, time_s);
  to.least_priced_s = std::min(to.least_priced_s, time_s - price * energy);
}

/// Docked at a node, what is left: over all flights from there, and being carried.
void OrderValue::compute_value(std::size_t node, Points& out) const {
  const double price = params_.battery.charge_s_per_unit;
  out.all.clear();
  out.least_time_s = kInfinity;
  out.least_priced_s = kInfinity;
  if (node == end_node()) {
    add_corner(out, 0.0, 0.0);
    return;
  }
  const auto take = [&](std::size_t to, const Cost& air) {
    const Points& next = value(to);
    Flight flight;
    if (next.all.empty()) return;
    // Whatever is made of it, one of those so far needs no more time and no more energy.
    const double flown_s = air.time_s + handling_s(to);
    const double time_s = flown_s + next.least_time_s;
    const double priced_s = flown_s + std::max(next.least_priced_s + price * air.energy,
                                               next.least_time_s + price * least_needs(air));
    const bool is_beaten = std::ranges::any_of(out.all, [&](const Point& p) {
      return p.time_s <= time_s && p.time_s + price * p.energy <= priced_s;
    });
    if (is_beaten || !make_flight(node, to, air, flight)) return;
    for (const Point& p : next.all)
      add_corner(out, flight.time_s + p.time_s, std::max(flight.needs, p.energy + flight.consumes));
  };
  for_each_flight_from(node, 0, take);
  if (node % 2 == 0) return;
  const Step& at = step(node / 2);
  take(node + 1, at.by_air);
  if (at.same_site) return;
  for (const Point& p : value(node + 1).all)
    add_corner(out, p.time_s + at.drive_s, price > 0.0 ? std::max(0.0, p.energy - at.drive_s / price) : 0.0);
}

void OrderValue::compute_labels(std::size_t node, Points& out) const {
  const double price = params_.battery.charge_s_per_unit;
  out.all.clear();
  out.least_time_s = kInfinity;
  out.least_priced_s = kInfinity;
  const auto take = [&](std::size_t from, const Cost& air) {
    if (from == 0 && !is_docked()) {
      Point docked{};
      if (first_flight(node, air, docked)) add_label(out, docked.time_s, docked.energy);
      return;
    }
    const Points& before = labels_[from];
    Flight flight;
    if (before.all.empty()) return;
    const double flown_s = air.time_s + handling_s(node);
    const double priced_s = flown_s + before.least_priced_s + price * air.energy;
    const double time_s =
        flown_s + std::max(before.least_time_s, before.least_priced_s + price * least_needs(air));
    const bool is_beaten = std::ranges::any_of(out.all, [&](const Point& p) {
      return p.time_s <= time_s && p.time_s - price * p.energy <= priced_s;
    });
    if (is_beaten || !make_flight(from, node, air, flight)) return;
    for (const Point& p : before.all) {
      const double charged = std::max(0.0, flight.needs - p.energy);
      add_label(out, p.time_s + price * charged + flight.time_s, p.energy + charged - flight.consumes);
    }
  };
  for_each_flight_to(node, take);
  if (node % 2 == 1) return;
  const Step& before = step(node / 2 - 1);
  take(node - 1, before.by_air);
  if (before.same_site) return;
  for (const Point& p : labels_[node - 1].all) {
    const double room = std::max(0.0, params_.battery.capacity - p.energy);
    add_label(out, p.time_s + before.drive_s,
              p.energy + (price > 0.0 ? std::min(room, before.drive_s / price) : room));
  }
}

/// What is left after docking at a node with so much.
double OrderValue::rest(std::size_t node, double energy) const {
  double least = kInfinity;
  for (const Point& p : value(node).all)
    least = std::min(least, p.time_s + params_.battery.charge_s_per_unit * std::max(0.0, p.energy - energy));
  return least;
}

double OrderValue::best_from_start(std::size_t border, double cutoff_s) const {
  double best = cutoff_s;
  for_each_flight_from(0, border, [&](std::size_t to, const Cost& air) {
    Point docked{};
    if (first_flight(to, air, docked)) best = std::min(best, docked.time_s + rest(to, docked.energy));
  });
  return best;
}

/// Over all flights from a node before `border` to it or beyond.
double OrderValue::best_over(std::size_t border, double cutoff_s) const {
  const double price = params_.battery.charge_s_per_unit;
  const double most = most_flown();
  double best = cutoff_s;
  double between = 0.0;
  for (std::size_t from = border; from-- > 0;) {
    const std::size_t first = first_leg(from);
    if (from % 2 == 1 && 2 * first < border) between += step(first).cover.energy + step(first).hop.energy;
    if (between > most) return best;
    if (from == 0 && !is_docked()) return best_from_start(border, best);
    const Points& labels = labels_[from];
    if (labels.all.empty()) continue;
    const auto take = [&](std::size_t to, const Cost& air) {
      const Points& next = value(to);
      Flight flight;
      // Flown, charged before with what is needed for that at least, and with what is left to do besides.
      const double left_s =
          std::max(next.least_time_s + price * least_needs(air), next.least_priced_s + price * air.energy);
      const double least_s =
          air.time_s + handling_s(to) +
          std::max(labels.least_time_s + next.least_time_s, labels.least_priced_s + left_s);
      if (least_s >= best + kRounding || !make_flight(from, to, air, flight)) return;
      for (const Point& p : next.all) {
        const double time_s = flight.time_s + p.time_s;
        const double needs = std::max(flight.needs, p.energy + flight.consumes);
        for (const Point& label : labels.all)
          best = std::min(best, label.time_s + time_s + price * std::max(0.0, needs - label.energy));
      }
    };
    for_each_flight_from(from, border, take);
    if (from % 2 == 0 || from + 1 < border) continue;
    const Step& at = step(from / 2);
    take(from + 1, at.by_air);
    if (at.same_site) continue;
    for (const Point& label : labels.all) {
      const double room = std::max(0.0, params_.battery.capacity - label.energy);
      const double charged = price > 0.0 ? std::min(room, at.drive_s / price) : room;
      best = std::min(best, label.time_s + at.drive_s + rest(from + 1, label.energy + charged));
    }
  }
  return best;
}

double OrderValue::end_with(std::size_t first, std::span<const RouteLeg> legs, double cutoff_s) {
  lay(first, legs);
  const std::size_t border = std::max<std::size_t>(1, 2 * first);
  const std::size_t past = 2 * (first + legs.size());
  if (changed_values_.size() < past - border) changed_values_.resize(past - border);
  changed_node_ = border;
  changed_node_past_ = past;
  for (std::size_t node = past; node-- > border;) compute_value(node, changed_values_[node - border]);
  const double best = best_over(border, cutoff_s);
  forget_change();
  return best < cutoff_s ? best : kInfinity;
}

/// By how much the points have moved in time; infinite when they have changed otherwise.
double OrderValue::moved_by(const Points& before, const Points& now) {
  if (before.all.size() != now.all.size() || now.all.empty()) return kInfinity;
  const double moved = now.all.front().time_s - before.all.front().time_s;
  for (std::size_t i = 0; i < now.all.size(); ++i) {
    const bool same = std::abs(now.all[i].energy - before.all[i].energy) <= kRounding &&
                      std::abs(now.all[i].time_s - before.all[i].time_s - moved) <= kRounding;
    if (!same) return kInfinity;
  }
  return moved;
}

void OrderValue::move(Points& points, double by_s) {
  for (Point& p : points.all) p.time_s += by_s;
  points.least_time_s += by_s;
  points.least_priced_s += by_s;
}

/// Tells when nodes one after the other, as far as a battery reaches, have all moved by the same time.
bool OrderValue::Settling::settled(double moved_s, double energy, double most) {
  if (!(std::abs(moved_s - by_s) <= kRounding)) {
    by_s = moved_s;
    reach = 0.0;
    is_first = true;
  } else if (energy > 0.0) {
    if (!is_first) reach += energy;
    is_first = false;
  }
  return std::isfinite(by_s) && reach > most;
}

/// Of the nodes before `past`; those before `first` hang on the change only through the others.
void OrderValue::refresh_values(std::size_t first, std::size_t past) {
  Settling settling;
  for (std::size_t node = past; node-- > 1;) {
    Points& now = values_[node];
    std::swap(scratch_, now);
    compute_value(node, now);
    if (node >= first) continue;
    const double energy = node % 2 == 1 ? steps_[node / 2].cover.energy + steps_[node / 2].hop.energy : 0.0;
    if (!settling.settled(moved_by(scratch_, now), energy, most_flown())) continue;
    for (std::size_t other = 1; other < node; ++other) move(values_[other], settling.by_s);
    return;
  }
}

void OrderValue::refresh_labels(std::size_t first, std::size_t past) {
  Settling settling;
  for (std::size_t node = first; node <= end_node(); ++node) {
    Points& now = labels_[node];
    std::swap(scratch_, now);
    compute_labels(node, now);
    if (node < past) continue;
    const double energy = node % 2 == 1 ? steps_[node / 2].cover.energy + steps_[node / 2].hop.energy : 0.0;
    if (!settling.settled(moved_by(scratch_, now), energy, most_flown())) continue;
    for (std::size_t other = node + 1; other <= end_node(); ++other) move(labels_[other], settling.by_s);
    return;
  }
}

void OrderValue::set(std::vector<RouteLeg> legs) {
  legs_ = std::move(legs);
  steps_.clear();
  for (const RouteLeg& leg : legs_) steps_.push_back(make_step(leg));
  for (std::size_t i = 0; i + 1 < legs_.size(); ++i) link(steps_[i], legs_[i], steps_[i + 1], legs_[i + 1]);
  finish(steps_.back(), legs_.back());
  start_lift_ = start_lift(legs_.front());
  values_.assign(2 * legs_.size(), {});
  labels_.assign(2 * legs_.size(), {});
  if (is_docked()) add_label(labels_[0], start_.time_s, start_.energy);
  refresh_values(1, 2 * legs_.size());
  refresh_labels(1, 2 * legs_.size());
  end_s_ = best_over(1, kInfinity);
}

void OrderValue::replace(std::size_t first, std::span<const RouteLeg> legs) {
  lay(first, legs);
  std::copy(changed_.begin(), changed_.end(), steps_.begin() + static_cast<std::ptrdiff_t>(changed_first_));
  std::copy(legs.begin(), legs.end(), legs_.begin() + static_cast<std::ptrdiff_t>(first));
  if (is_lift_changed_) start_lift_ = changed_lift_;
  forget_change();
  const std::size_t border = std::max<std::size_t>(1, 2 * first);
  const std::size_t past = 2 * (first + legs.size());
  refresh_values(border, past);
  refresh_labels(border, past);
  end_s_ = best_over(1, kInfinity);
}

}  // namespace swallowtail::coverage
