#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "planner/base/clock.hpp"
#include "planner/base/result.hpp"
#include "qos/bus.hpp"
#include "qos/participant/due.hpp"
#include "qos/participant/percentiles.hpp"

namespace swallowtail {

struct StatusOptions {
  std::uint32_t participant_id = 0;  ///< data::ParticipantId
  std::string name;                  ///< at most 32 characters are sent
  double period_s = 0.5;             ///< wall time between two samples
};

/// Publishes this participant's ParticipantStatus: health, what the bus counted, replans and latency
/// percentiles. All but `step` may be called from any thread.
class StatusPublisher {
 public:
  static Result<std::unique_ptr<StatusPublisher>> make(Bus& bus, const Clock& clock, StatusOptions options);

  /// A change of health is published by the next `step`, due or not. At most 256 characters of the message
  /// are sent.
  void set_health(data::Health health, std::string_view message = {});

  void count_replan() { replans_.fetch_add(1, std::memory_order_relaxed); }
  std::uint64_t replans() const { return replans_.load(std::memory_order_relaxed); }

  /// One measured reaction time, of the kind that this participant is judged by.
  void add_latency_ms(double latency_ms) { latency_ms_.add(latency_ms); }
  Percentiles::Summary latency_ms() const { return latency_ms_.summary(); }

  /// Publishes when a period is over or the health has changed. Call it from the main loop.
  Status step();

  /// What the next sample will say.
  data::ParticipantStatus sample() const;

 private:
  StatusPublisher(Bus& bus, const Clock& clock, StatusOptions options,
                  std::unique_ptr<Publisher<data::ParticipantStatus>> publisher);

  Bus& bus_;
  const Clock& clock_;
  const StatusOptions options_;
  std::unique_ptr<Publisher<data::ParticipantStatus>> publisher_;
  Percentiles latency_ms_;
  std::atomic<std::uint64_t> replans_{0};
  mutable std::mutex mutex_;
  data::Health health_ = data::Health::kStarting;
  std::string message_;
  bool changed_ = true;
  Due due_;
};

}  // namespace swallowtail
