#include "charger/charging/charging.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "planner/base/checks.hpp"

namespace swallowtail::charger {
namespace {

constexpr double kDockingHeight_m = 2.0;
/// So much more must be asked of a vehicle that is ready before charging starts again.
constexpr double kRecharge = 1.0;
/// The last bit is charged over so many steps, so that a late reaction of the vehicle's side does not
/// overshoot.
constexpr double kTaperSteps = 2.0;
constexpr std::size_t kMaxDeliveries = 1024;

bool is_near(const Vec3& a, const Vec3& b) {
  return (a.head<2>() - b.head<2>()).norm() <= kDocking_m && std::abs(a.z() - b.z()) <= kDockingHeight_m;
}

bool is_on_ground(const Inputs& inputs) {
  return inputs.vehicle && inputs.vehicle->activity == VehicleActivity::kOnGround;
}

bool is_flying(const Inputs& inputs) {
  return inputs.vehicle && inputs.vehicle->activity == VehicleActivity::kFlying;
}

bool is_sound(const Way& way) {
  return is_non_negative(way.speed_mps) &&
         std::all_of(way.bends_m.begin(), way.bends_m.end(), [](const Vec3& p) { return is_finite(p); });
}

Status refuse(const Orders& orders, const std::string& rule) {
  return bad_input("Charger orders of revision " + std::to_string(orders.revision) + ": " + rule + ".");
}

}  // namespace

Status validate(const Orders& orders) {
  if (!is_positive(orders.speed_mps)) return refuse(orders, "speed_mps must be positive");
  if (!is_positive(orders.charge_s_per_unit)) return refuse(orders, "charge_s_per_unit must be positive");
  if (!is_non_negative(orders.landing_s)) return refuse(orders, "landing_s must not be negative");
  if (!is_non_negative(orders.take_off_s)) return refuse(orders, "take_off_s must not be negative");
  if (!is_within(orders.taper_from, 0.0, 1.0) || !is_within(orders.taper_end_rate, 1e-3, 1.0))
    return refuse(orders, "the charging taper must lie within 0 and 1");
  if (!is_finite(orders.start_m)) return refuse(orders, "the start must be finite");
  if (orders.battery && !is_sound(*orders.battery))
    return refuse(orders, "its own battery must hold more than its reserve, and what it gives be positive");
  if (!is_sound(orders.home)) return refuse(orders, "the way home must be finite");
  for (const Meeting& meeting : orders.meetings) {
    if (!is_finite(meeting.site_m) || (meeting.carry_to_m && !is_finite(*meeting.carry_to_m))) {
      return refuse(orders, "the sites of meeting " + std::to_string(meeting.id) + " must be finite");
    }
    if (!is_non_negative(meeting.way_speed_mps) || !is_non_negative(meeting.carry_speed_mps) ||
        !std::all_of(meeting.way_m.begin(), meeting.way_m.end(),
                     [](const Vec3& p) { return is_finite(p); }) ||
        !std::all_of(meeting.carry_way_m.begin(), meeting.carry_way_m.end(),
                     [](const Vec3& p) { return is_finite(p); })) {
      return refuse(orders, "the ways of meeting " + std::to_string(meeting.id) + " must be finite");
    }
    if (!is_sound(meeting.home) || !is_non_negative(meeting.uses))
      return refuse(orders, "the way home from meeting " + std::to_string(meeting.id) + " must be finite");
    if (!is_non_negative(meeting.charge_to)) {
      return refuse(orders, "charge_to of meeting " + std::to_string(meeting.id) + " must not be negative");
    }
  }
  return {};
}

Result<Charging> Charging::make(Orders orders, std::vector<Delay> delays, double time_s,
                                std::vector<Loss> losses) {
  if (Status status = validate(orders); !status) return status.error();
  return Charging(std::move(orders), std::move(delays), time_s, std::move(losses));
}

Charging::Charging(Orders orders, std::vector<Delay> delays, double time_s, std::vector<Loss> losses)
    : orders_(std::move(orders)),
      delays_(std::move(delays)),
      drive_(orders_.start_m),
      losses_(std::move(losses)) {
  own_.limit(orders_.battery);
  state_.energy = own_.energy();
  state_.time_s = time_s;
  state_.position_m = orders_.start_m;
  state_.orders_revision = orders_.revision;
}

Status Charging::set_orders(Orders orders) {
  if (Status status = validate(orders); !status) return status;
  orders_ = std::move(orders);
  own_.limit(orders_.battery);
  home_ = orders_.home;
  sets_out_anew_ = true;
  return {};
}

const State& Charging::step(double time_s, const Inputs& inputs) {
  if (!(time_s >= state_.time_s)) return state_;
  const double duration_s = std::min(time_s - state_.time_s, kLongestStep_s);
  state_.time_s = time_s;
  suffer_losses();
  account_for_delivery(inputs, duration_s);
  forget_replaced_vehicle(inputs);
  vehicle_has_flown_ =
      vehicle_has_flown_ || is_flying(inputs) || (inputs.vehicle && inputs.vehicle->legs_done > 0);

  if (service_ == Service::kNone && inputs.vehicle && inputs.vehicle->docked_here) adopt_vehicle(inputs);
  if (service_ != Service::kNone && (is_flying(inputs) || has_left(inputs))) finish();
  if (service_ == Service::kNone) {
    approach(inputs, duration_s);
  } else {
    follow_changed_meeting(inputs);
    serve(inputs, duration_s);
  }

  state_.position_m = drive_.position_m();
  state_.speed_mps = drive_.speed_mps();
  state_.has_vehicle = service_ != Service::kNone;
  state_.orders_revision = orders_.revision;
  state_.energy = own_.energy();
  return state_;
}

/// One that has fewer legs done is another, to which no meeting is behind.
void Charging::forget_replaced_vehicle(const Inputs& inputs) {
  if (!inputs.vehicle) return;
  if (inputs.vehicle->legs_done < legs_seen_) {
    if (service_ != Service::kNone) finish();
    last_done_.reset();
    depot_done_.reset();
    vehicle_has_flown_ = false;
  }
  legs_seen_ = inputs.vehicle->legs_done;
}

void Charging::account_for_delivery(const Inputs& inputs, double duration_s) {
  state_.energy_delivered += state_.charge_rate * duration_s;
  own_.give(state_.charge_rate * duration_s);
  deliveries_.push_back({state_.time_s, state_.energy_delivered});
  const double known_s = inputs.battery ? inputs.battery->time_s : -std::numeric_limits<double>::infinity();
  while (deliveries_.size() > kMaxDeliveries ||
         (deliveries_.size() > 1 && deliveries_[1].time_s <= known_s)) {
    deliveries_.pop_front();
  }
}

/// What the battery holds by now, by its newest sample and what was delivered since; NaN without one.
double Charging::energy_now(const Inputs& inputs) const {
  if (!inputs.battery) return std::numeric_limits<double>::quiet_NaN();
  const BatteryView& battery = *inputs.battery;
  double delivered_before = deliveries_.front().energy;
  if (deliveries_.size() > 1 && battery.time_s > deliveries_[0].time_s) {
    const Delivery& from = deliveries_[0];
    const Delivery& to = deliveries_[1];
    const double share = std::min(1.0, (battery.time_s - from.time_s) / (to.time_s - from.time_s));
    delivered_before += share * (to.energy - from.energy);
  }
  return battery.energy + state_.energy_delivered - delivered_before;
}

double Charging::missing_energy(const Inputs& inputs) const {
  if (!inputs.battery) return std::numeric_limits<double>::quiet_NaN();
  return std::min(current_.charge_to, inputs.battery->capacity) - energy_now(inputs);
}

/// Constant, then falling in a straight line over the energy held.
double Charging::greatest_rate(const BatteryView& battery, double energy) const {
  const double begin = orders_.taper_from * battery.capacity;
  const double full = 1.0 / orders_.charge_s_per_unit;
  if (orders_.taper_from >= 1.0 || energy <= begin) return full;
  const double way = std::min(1.0, (energy - begin) / (battery.capacity - begin));
  return full * (1.0 - way * (1.0 - orders_.taper_end_rate));
}

bool Charging::is_behind(const Meeting& meeting, const Inputs& inputs) const {
  const std::uint32_t legs_before = (meeting.id + 1) / 2;
  if (inputs.vehicle && legs_before < inputs.vehicle->legs_done) return true;
  if (meeting.is_depot) {
    const bool is_kept = depot_done_ == meeting.id || (last_done_ && meeting.id <= last_done_->id);
    return is_kept || (own_.is_full() && drive_.stands_at(orders_.start_m));
  }
  if (!last_done_) return false;
  if (meeting.id != last_done_->id) return meeting.id < last_done_->id;
  return orders_.revision == last_done_revision_ || is_near(meeting.site_m, last_done_->site_m);
}

bool Charging::waits_for_us(const Meeting& meeting, const Inputs& inputs) const {
  if (!is_on_ground(inputs) || !is_near(meeting.site_m, inputs.vehicle->position_m)) return false;
  // Before its next leg, at whose entry they are to meet, it waits whether it has flown or not.
  return vehicle_has_flown_ || meeting.id == 2 * inputs.vehicle->legs_done ||
         state_.time_s > meeting.arrive_by_s + kOverdue_s;
}

/// On the ground somewhere else: it flew there unseen.
bool Charging::has_left(const Inputs& inputs) const {
  return is_on_ground(inputs) && !inputs.vehicle->docked_here &&
         !is_near(drive_.position_m(), inputs.vehicle->position_m);
}

const Meeting* Charging::next_meeting(const Inputs& inputs) const {
  const Meeting* next = nullptr;
  const Meeting* depot = nullptr;
  for (const Meeting& meeting : orders_.meetings) {
    const bool behind = is_behind(meeting, inputs);
    if (meeting.is_depot && !behind) depot = &meeting;
    // A vehicle that came back to a place it had left is served again once newer orders say so.
    if (!meeting.is_depot && waits_for_us(meeting, inputs) &&
        (!behind || orders_.revision != last_done_revision_))
      return depot != nullptr && depot->id == meeting.id ? depot : &meeting;
    if (next == nullptr && !behind) next = &meeting;
  }
  return next;
}

bool Charging::is_delayed() const {
  return std::any_of(delays_.begin(), delays_.end(), [this](const Delay& delay) {
    return state_.time_s >= delay.at_s && state_.time_s < delay.at_s + delay.duration_s;
  });
}

bool Charging::is_held_up() {
  if (!is_delayed() && !own_.is_empty()) return false;
  drive_.stop();
  state_.activity = Activity::kDelayed;
  return true;
}

void Charging::drive_to_site(const Meeting& meeting, double duration_s) {
  if (is_held_up()) return;
  drive({meeting.way_m, meeting.way_speed_mps}, meeting.site_m, duration_s);
  state_.activity = Activity::kDriving;
}

void Charging::carry(double duration_s) {
  if (is_held_up()) return;
  drive({current_.carry_way_m, current_.carry_speed_mps}, *current_.carry_to_m, duration_s);
  state_.activity = Activity::kCarrying;
}

void Charging::approach(const Inputs& inputs, double duration_s) {
  state_.charge_rate = 0.0;
  refill_when_due();
  const Meeting* next = next_meeting(inputs);
  if (errand_ == Errand::kRefilling) {
    drive_.stop();
    state_.activity = Activity::kRefilling;
    return;
  }
  if (next == nullptr) {
    drive_.stop();
    state_.activity = Activity::kIdle;
    return;
  }
  state_.meeting_id = next->id;
  if (has_an_errand(*next))
    return fetch(next->is_depot ? Way{next->way_m, next->way_speed_mps} : home_, duration_s);
  if (!drive_.stands_at(next->site_m)) {
    drive_to_site(*next, duration_s);
    return;
  }
  drive_.stop();
  state_.activity = Activity::kWaiting;
  if (waits_for_us(*next, inputs)) take_on_board(*next);
}

void Charging::take_on_board(const Meeting& meeting) {
  current_ = meeting;
  service_ = Service::kLanding;
  errand_ = Errand::kNone;
  handling_until_s_ = state_.time_s + orders_.landing_s;
  state_.meeting_id = meeting.id;
  state_.activity = Activity::kCharging;
}

void Charging::adopt_vehicle(const Inputs& inputs) {
  drive_ = Drive(inputs.vehicle->position_m);
  const Meeting* next = next_meeting(inputs);
  const bool ours =
      next != nullptr && (next->carry_to_m || is_near(next->site_m, inputs.vehicle->position_m));
  current_ = Meeting();
  if (ours) current_ = *next;
  state_.meeting_id = current_.id;
  service_ = Service::kServing;
}

void Charging::follow_changed_meeting(const Inputs& inputs) {
  if (orders_.revision == state_.orders_revision) return;
  auto same = std::find_if(orders_.meetings.begin(), orders_.meetings.end(), [this](const Meeting& meeting) {
    return !meeting.is_depot && meeting.id == current_.id;
  });
  // The next meeting, here, is this one under another number.
  if (same == orders_.meetings.end() && !orders_.meetings.empty() && !orders_.meetings.front().is_depot &&
      is_near(orders_.meetings.front().site_m, drive_.position_m()))
    same = orders_.meetings.begin();
  if (same == orders_.meetings.end()) return;
  current_.id = same->id;
  state_.meeting_id = current_.id;
  current_.charge_to = same->charge_to;
  current_.carry_to_m = same->carry_to_m;
  current_.carry_way_m = same->carry_way_m;
  current_.carry_speed_mps = same->carry_speed_mps;
  current_.home = same->home;
  if (service_ != Service::kTakeOff && service_ != Service::kReady) return;
  const bool must_drive = current_.carry_to_m && !drive_.stands_at(*current_.carry_to_m);
  if (must_drive || missing_energy(inputs) > kRecharge) service_ = Service::kServing;
}

void Charging::charge(const Inputs& inputs, double duration_s) {
  const double missing = missing_energy(inputs);
  state_.charge_rate = 0.0;
  if (!(missing > kChargeTolerance)) return;
  const double taper_s = kTaperSteps * duration_s;
  const double greatest = greatest_rate(*inputs.battery, energy_now(inputs));
  state_.charge_rate = missing < greatest * taper_s ? missing / taper_s : greatest;
  if (!own_.is_limited()) return;
  const double spare = own_.to_spare() - for_the_way_home(current_);
  if (spare < own_.for_charging(kChargeTolerance)) {
    state_.charge_rate = 0.0;
  } else if (own_.for_charging(state_.charge_rate) * taper_s > spare) {
    state_.charge_rate = spare / own_.for_charging(taper_s);
  }
}

void Charging::serve(const Inputs& inputs, double duration_s) {
  drive_.stop();
  if (service_ == Service::kLanding && state_.time_s >= handling_until_s_) service_ = Service::kServing;
  // What a battery loses while it waits to leave is charged again.
  const bool leaves = service_ == Service::kTakeOff || service_ == Service::kReady;
  if (leaves && missing_energy(inputs) > kRecharge) service_ = Service::kServing;
  if (errand_ != Errand::kNone) return run_errand_on_board(duration_s);
  if (service_ == Service::kServing) {
    const bool arrived = !current_.carry_to_m || drive_.stands_at(*current_.carry_to_m);
    charge(inputs, duration_s);
    if (!arrived) {
      carry(duration_s);
      return;
    }
    state_.activity = Activity::kCharging;
    if (missing_energy(inputs) <= kChargeTolerance) {
      service_ = Service::kTakeOff;
      handling_until_s_ = state_.time_s + orders_.take_off_s;
    } else {
      begin_errand_on_board(inputs);
    }
  }
  if (service_ == Service::kTakeOff && state_.time_s >= handling_until_s_) {
    service_ = Service::kReady;
    state_.activity = Activity::kReady;
  }
}

void Charging::finish() {
  service_ = Service::kNone;
  state_.charge_rate = 0.0;
  ++state_.meetings_done;
  last_done_ = current_;
  last_done_revision_ = orders_.revision;
  depot_done_.reset();
  errand_ = Errand::kNone;
  sets_out_anew_ = true;
  home_ = current_.home;
}

}  // namespace swallowtail::charger
