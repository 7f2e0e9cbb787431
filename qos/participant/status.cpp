#include "qos/participant/status.hpp"

#include <algorithm>
#include <utility>

namespace swallowtail {
namespace {

// Bounds of the IDL's strings.
constexpr std::size_t kNameChars = 32;
constexpr std::size_t kTopicChars = 32;
constexpr std::size_t kReasonChars = 64;
constexpr std::size_t kMessageChars = 256;

}  // namespace

Result<std::unique_ptr<StatusPublisher>> StatusPublisher::make(Bus& bus, const Clock& clock,
                                                               StatusOptions options) {
  auto publisher = bus.publisher<data::ParticipantStatus>();
  if (!publisher) return publisher.error();
  return std::unique_ptr<StatusPublisher>(
      new StatusPublisher(bus, clock, std::move(options), std::move(publisher).value()));
}

StatusPublisher::StatusPublisher(Bus& bus, const Clock& clock, StatusOptions options,
                                 std::unique_ptr<Publisher<data::ParticipantStatus>> publisher)
    : bus_(bus),
      clock_(clock),
      options_(std::move(options)),
      publisher_(std::move(publisher)),
      due_(options_.period_s) {}

void StatusPublisher::set_health(data::Health health, std::string_view message) {
  const std::lock_guard lock(mutex_);
  changed_ = changed_ || health != health_;
  health_ = health;
  message_.assign(message.substr(0, kMessageChars));
}

data::ParticipantStatus StatusPublisher::sample() const {
  data::ParticipantStatus status;
  status.participant_id = options_.participant_id;
  status.name = options_.name.substr(0, kNameChars);
  BusStatistics wire = bus_.statistics();
  status.accepted = wire.accepted;
  status.rejected = std::move(wire.rejected);
  status.rejected.resize(std::min<std::size_t>(status.rejected.size(), data::kMaxRejections));
  for (data::Rejection& rejection : status.rejected) {
    rejection.topic.resize(std::min(rejection.topic.size(), kTopicChars));
    rejection.reason.resize(std::min(rejection.reason.size(), kReasonChars));
  }
  status.missed_deadlines = wire.missed_deadlines;
  status.incompatible_qos = wire.incompatible_qos;
  status.replans = replans();
  const Percentiles::Summary latency = latency_ms_.summary();
  status.latency_p50_ms = latency.p50;
  status.latency_p99_ms = latency.p99;
  status.latency_max_ms = latency.max;
  const std::lock_guard lock(mutex_);
  status.health = health_;
  status.message = message_;
  return status;
}

Status StatusPublisher::step() {
  const double now_s = clock_.now_s();
  {
    const std::lock_guard lock(mutex_);
    if (changed_) {
      due_.put_off(now_s);
    } else if (!due_(now_s)) {
      return {};
    }
    changed_ = false;
  }
  return publisher_->publish(sample());
}

}  // namespace swallowtail
