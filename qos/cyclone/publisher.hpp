#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "idl/data/validate.hpp"
#include "qos/bus.hpp"
#include "qos/counters.hpp"
#include "qos/cyclone/participant.hpp"
#include "qos/cyclone/qos.hpp"
#include "qos/cyclone/wire.hpp"
#include "qos/refused.hpp"

namespace swallowtail::cyclone {

/// Counts what goes wrong at a writer; `counters` must outlive the entity that the listener is given to.
Listener writer_events(Counters* counters);

template <class T>
class CyclonePublisher final : public Publisher<T> {
 public:
  static Result<std::unique_ptr<Publisher<T>>> open(std::shared_ptr<Participant> participant,
                                                    std::shared_ptr<Counters> counters,
                                                    const PublisherOptions& options) {
    const std::string name = kRow.name;
    auto topic = owned(dds_create_topic(participant->get(), &codec::cyclone::descriptor<Wire>(), kRow.name,
                                        nullptr, nullptr),
                       "topic " + name);
    if (!topic) return topic.error();
    const Listener events = writer_events(counters.get());
    auto writer = owned(dds_create_writer(participant->get(), topic->get(),
                                          writer_qos(kRow, options.ownership_strength).get(), events.get()),
                        "writer of " + name);
    if (!writer) return writer.error();
    return std::unique_ptr<Publisher<T>>(new CyclonePublisher(std::move(participant), std::move(counters),
                                                              std::move(*topic), std::move(*writer)));
  }

  Status publish(const T& sample) override {
    if (const data::Refusal refusal = data::validate(sample)) return refused(kRow, *refusal);
    const std::lock_guard lock(mutex_);
    codec::cyclone::to_wire(sample, *wire_);
    return write();
  }

  Status dispose(const T& last) override {
    if (const data::Refusal refusal = data::validate(last)) return refused(kRow, *refusal);
    const std::lock_guard lock(mutex_);
    codec::cyclone::to_wire(last, *wire_);
    has_sample_ = false;
    // Not dds_dispose: its key-only payload names a wrong instance to Fast DDS readers.
    dds_return_t code = dds_writedispose(writer_.get(), wire_.get());
    if (code == DDS_RETCODE_OK) code = dds_unregister_instance(writer_.get(), wire_.get());
    return code == DDS_RETCODE_OK ? Status{} : failure("does not dispose the", code);
  }

  void assert_liveliness() override {
    if constexpr (kRow.lease_ms > 0) {
      const std::lock_guard lock(mutex_);
      const bool was_lost = Clock::now() - asserted_ > std::chrono::milliseconds(kRow.lease_ms);
      if (was_lost && has_sample_) {
        (void)write();  // readers took the instance for dead, and only a sample revives it
        return;
      }
      dds_assert_liveliness(writer_.get());
      asserted_ = Clock::now();
    }
  }

 private:
  using Wire = typename WireOf<T>::Wire;
  using Clock = std::chrono::steady_clock;
  static constexpr const TopicQos& kRow = TopicOf<T>::qos;

  CyclonePublisher(std::shared_ptr<Participant> participant, std::shared_ptr<Counters> counters, Entity topic,
                   Entity writer)
      : participant_(std::move(participant)),
        counters_(std::move(counters)),
        topic_(std::move(topic)),
        writer_(std::move(writer)) {}

  Status write() {
    asserted_ = Clock::now();
    const dds_return_t code = dds_write(writer_.get(), wire_.get());
    if (code != DDS_RETCODE_OK) return failure("does not write the", code);
    has_sample_ = true;
    return {};
  }

  static Error failure(const char* what, dds_return_t code) {
    return internal_error(std::string("Cyclone DDS ") + what + " " + kRow.name +
                          " sample: " + dds_strretcode(code) + ".");
  }

  const std::shared_ptr<Participant> participant_;
  const std::shared_ptr<Counters> counters_;
  Entity topic_;
  Entity writer_;
  std::mutex mutex_;
  codec::cyclone::Sample<Wire> wire_;  ///< what was written last; its memory is reused
  bool has_sample_ = false;
  Clock::time_point asserted_ = Clock::now();
};

}  // namespace swallowtail::cyclone
