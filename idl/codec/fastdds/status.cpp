#include "idl/codec/fastdds/status.hpp"

namespace swallowtail::codec::fast {

namespace {

data::Refusal get_rejection(const swallowtail_wire::Rejection& w, data::Rejection& d) {
  get_text(w.topic(), d.topic);
  get_text(w.reason(), d.reason);
  d.count = w.count();
  return {};
}

void put_rejection(const data::Rejection& d, swallowtail_wire::Rejection& w) {
  put_text(d.topic, w.topic());
  put_text(d.reason, w.reason());
  w.count() = d.count;
}

}  // namespace

data::Refusal to_data(const swallowtail_wire::ChargerState& w, data::ChargerState& d) {
  d.charger_id = w.charger_id();
  d.time_s = w.time_s();
  d.position = vec3(w.position());
  d.speed_mps = w.speed_mps();
  d.docked_vehicle_id = w.docked_vehicle_id();
  d.charge_rate = w.charge_rate();
  d.energy_delivered = w.energy_delivered();
  if (!get_enum(w.activity(), data::ChargerActivity::kRefilling, d.activity)) return kBadEnumerator;
  d.rendezvous_id = w.rendezvous_id();
  d.rendezvous_done = w.rendezvous_done();
  d.plan_revision = w.plan_revision();
  d.energy = w.energy();
  return {};
}

void to_wire(const data::ChargerState& d, swallowtail_wire::ChargerState& w) {
  w.charger_id() = d.charger_id;
  w.time_s() = d.time_s;
  w.position() = vec3(d.position);
  w.speed_mps() = d.speed_mps;
  w.docked_vehicle_id() = d.docked_vehicle_id;
  w.charge_rate() = d.charge_rate;
  w.energy_delivered() = d.energy_delivered;
  put_enum(d.activity, w.activity());
  w.rendezvous_id() = d.rendezvous_id;
  w.rendezvous_done() = d.rendezvous_done;
  w.plan_revision() = d.plan_revision;
  w.energy() = d.energy;
}

data::Refusal to_data(const swallowtail_wire::ParticipantStatus& w, data::ParticipantStatus& d) {
  d.participant_id = w.participant_id();
  get_text(w.name(), d.name);
  if (!get_enum(w.health(), data::Health::kFailed, d.health)) return kBadEnumerator;
  d.accepted = w.accepted();
  if (const auto refusal = get_sequence(w.rejected(), data::kMaxRejections, d.rejected, get_rejection))
    return refusal;
  d.missed_deadlines = w.missed_deadlines();
  d.incompatible_qos = w.incompatible_qos();
  d.replans = w.replans();
  d.latency_p50_ms = w.latency_p50_ms();
  d.latency_p99_ms = w.latency_p99_ms();
  d.latency_max_ms = w.latency_max_ms();
  get_text(w.message(), d.message);
  return {};
}

void to_wire(const data::ParticipantStatus& d, swallowtail_wire::ParticipantStatus& w) {
  w.participant_id() = d.participant_id;
  put_text(d.name, w.name());
  put_enum(d.health, w.health());
  w.accepted() = d.accepted;
  put_sequence(d.rejected, w.rejected(), put_rejection);
  w.missed_deadlines() = d.missed_deadlines;
  w.incompatible_qos() = d.incompatible_qos;
  w.replans() = d.replans;
  w.latency_p50_ms() = d.latency_p50_ms;
  w.latency_p99_ms() = d.latency_p99_ms;
  w.latency_max_ms() = d.latency_max_ms;
  put_text(d.message, w.message());
}

}  // namespace swallowtail::codec::fast
