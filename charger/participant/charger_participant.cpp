#include "charger/participant/charger_participant.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "charger/participant/convert.hpp"

namespace swallowtail::charger {
namespace {

/// A mission time this far behind the robot's own is a new mission.
constexpr double kRestart_s = 5.0;
/// A battery that has not told of itself for so long has been exchanged.
constexpr double kHeard_s = 5.0;

}  // namespace

Result<std::unique_ptr<ChargerParticipant>> ChargerParticipant::make(Bus& bus, const Clock& clock,
                                                                     ParticipantOptions options) {
  std::unique_ptr<ChargerParticipant> charger(new ChargerParticipant(bus, clock, std::move(options)));
  if (Status status = charger->connect(); !status) return status.error();
  return charger;
}

ChargerParticipant::ChargerParticipant(Bus& bus, const Clock& clock, ParticipantOptions options)
    : bus_(bus), clock_(clock), options_(std::move(options)), due_(options_.publish_period_s) {}

Status ChargerParticipant::connect() {
  auto status = StatusPublisher::make(bus_, clock_, {.participant_id = data::kChargerId, .name = "charger"});
  if (!status) return status.error();
  status_ = std::move(status).value();
  auto publisher = bus_.publisher<data::ChargerState>();
  if (!publisher) return publisher.error();
  publisher_ = std::move(publisher).value();
  if (Status subscribed = subscribe(); !subscribed) return subscribed;
  status_->set_health(data::Health::kReady, "waits for a plan");
  return {};
}

Status ChargerParticipant::subscribe() {
  Bus* bus = &bus_;
  const Clock* wall = &clock_;
  const auto inbox = inbox_;
  Status done =
      bus_.subscribe<data::MissionClock>({.on_sample = [inbox, wall](const data::MissionClock& clock) {
        inbox->time.update(clock, wall->now_s());
      }});
  if (!done) return done;
  done = bus_.subscribe<data::ChargerPlan>(
      {.on_sample = [inbox, bus, charger_id = options_.charger_id](const data::ChargerPlan& plan) {
        if (plan.charger_id != charger_id) return bus->count_rejection("ChargerPlan", "unknown charger");
        inbox->plan.put(plan);
      }});
  if (!done) return done;
  const auto is_stranger = [inbox](std::uint32_t vehicle_id) {
    const std::uint32_t ours = inbox->vehicle_id.load();
    return ours != 0 && vehicle_id != ours;
  };
  done = bus_.subscribe<data::VehicleState>(
      {.on_sample = [inbox, bus, is_stranger](const data::VehicleState& state) {
        if (is_stranger(state.vehicle_id)) return bus->count_rejection("VehicleState", "unknown vehicle");
        // One that has fewer legs done is another, with a battery of its own.
        if (state.legs_done < inbox->legs_done.exchange(state.legs_done)) {
          inbox->since_s.store(state.time_s);
          inbox->capacity.store(0.0);
        }
        inbox->vehicle.put(state);
      }});
  if (!done) return done;
  return bus_.subscribe<data::BatteryState>(
      {.on_sample = [inbox, bus, is_stranger](const data::BatteryState& state) {
        if (is_stranger(state.vehicle_id)) return bus->count_rejection("BatteryState", "unknown vehicle");
        if (state.time_s < inbox->since_s.load()) return;
        // A battery does not grow: what tells of another capacity is not our aircraft's, as long as ours
        // tells of itself.
        const double known = inbox->capacity.load();
        const bool is_other = known != 0.0 && state.capacity != known;
        if (is_other && std::abs(state.time_s - inbox->heard_s.load()) <= kHeard_s)
          return bus->count_rejection("BatteryState", "another capacity");
        inbox->capacity.store(state.capacity);
        inbox->heard_s.store(state.time_s);
        inbox->battery.put(state);
      }});
}

void ChargerParticipant::take_plan(double time_s) {
  if (const auto plan = inbox_->plan.take()) {
    orders_ = to_orders(*plan);
    if (inbox_->vehicle_id.exchange(plan->vehicle_id) != plan->vehicle_id) {
      inbox_->capacity.store(0.0);
      inbox_->since_s.store(0.0);
    }
    Status accepted;
    if (charging_) {
      accepted = charging_->set_orders(orders_);
    } else if (auto made = Charging::make(orders_, options_.delays, time_s, options_.losses)) {
      charging_.emplace(std::move(made).value());
    } else {
      accepted = made.error();
    }
    if (accepted) {
      status_->set_health(data::Health::kReady, "follows plan revision " + std::to_string(orders_.revision));
    } else {
      bus_.count_rejection("ChargerPlan", "orders out of range");
    }
  }
  if (charging_ && time_s < charging_->state().time_s - kRestart_s) {
    if (auto anew = Charging::make(orders_, options_.delays, time_s, options_.losses))
      charging_.emplace(std::move(anew).value());
    inputs_ = {};
  }
}

void ChargerParticipant::take_views() {
  const std::uint32_t vehicle_id = inbox_->vehicle_id.load();
  if (const auto state = inbox_->vehicle.take(); state && state->vehicle_id == vehicle_id) {
    inputs_.vehicle = to_view(*state, options_.charger_id);
  }
  if (const auto state = inbox_->battery.take(); state && state->vehicle_id == vehicle_id) {
    inputs_.battery = to_view(*state);
  }
}

Status ChargerParticipant::publish(const State& state) {
  const data::ChargerState next = to_data(state, options_.charger_id, inbox_->vehicle_id.load());
  const double wall_s = clock_.now_s();
  const bool changed =
      !published_ || next.activity != published_->activity || next.charge_rate != published_->charge_rate ||
      next.docked_vehicle_id != published_->docked_vehicle_id ||
      next.plan_revision != published_->plan_revision || next.rendezvous_id != published_->rendezvous_id;
  if (changed) {
    due_.put_off(wall_s);
  } else if (!due_(wall_s)) {
    return {};
  }
  published_ = next;
  return publisher_->publish(next);
}

Status ChargerParticipant::step() {
  const double time_s = inbox_->time.now_s(clock_.now_s());
  take_plan(time_s);
  if (charging_) {
    take_views();
    if (Status sent = publish(charging_->step(time_s, inputs_)); !sent) return sent;
  }
  return status_->step();
}

}  // namespace swallowtail::charger
