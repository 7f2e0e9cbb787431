#pragma once

#include <chrono>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "idl/data/validate.hpp"
#include "qos/bus.hpp"
#include "qos/counters.hpp"
#include "qos/fastdds/participant.hpp"
#include "qos/fastdds/qos.hpp"
#include "qos/fastdds/type.hpp"
#include "qos/refused.hpp"

namespace swallowtail::fast {

/// Counts what goes wrong at a writer.
class WriterEvents final : public eprosima::fastdds::dds::DataWriterListener {
 public:
  explicit WriterEvents(std::shared_ptr<Counters> counters) : counters_(std::move(counters)) {}
  void on_offered_deadline_missed(
      eprosima::fastdds::dds::DataWriter*,
      const eprosima::fastdds::dds::OfferedDeadlineMissedStatus& status) override {
    counters_->miss_deadlines(static_cast<std::uint64_t>(status.total_count_change));
  }
  void on_offered_incompatible_qos(
      eprosima::fastdds::dds::DataWriter*,
      const eprosima::fastdds::dds::OfferedIncompatibleQosStatus& status) override {
    counters_->meet_incompatible(static_cast<std::uint64_t>(status.total_count_change));
  }

 private:
  const std::shared_ptr<Counters> counters_;
};

template <class T>
class FastPublisher final : public Publisher<T> {
 public:
  static Result<std::unique_ptr<Publisher<T>>> open(std::shared_ptr<Participant> participant,
                                                    std::shared_ptr<Counters> counters,
                                                    const PublisherOptions& options) {
    auto* topic = participant->topic(kRow, eprosima::fastdds::dds::TypeSupport(new Type<T>()));
    if (!topic) return internal_error("Fast DDS makes no topic " + std::string(kRow.name) + ".");
    auto events = std::make_unique<WriterEvents>(std::move(counters));
    auto* writer = participant->publisher()->create_datawriter(
        topic, writer_qos(kRow, options.ownership_strength), events.get());
    if (!writer) return internal_error("Fast DDS makes no writer of " + std::string(kRow.name) + ".");
    return std::unique_ptr<Publisher<T>>(
        new FastPublisher(std::move(participant), std::move(events), writer));
  }

  ~FastPublisher() override { participant_->publisher()->delete_datawriter(writer_); }
  FastPublisher(const FastPublisher&) = delete;
  FastPublisher& operator=(const FastPublisher&) = delete;

  Status publish(const T& sample) override {
    if (const data::Refusal refusal = data::validate(sample)) return refused(kRow, *refusal);
    const std::lock_guard lock(mutex_);
    codec::fast::to_wire(sample, wire_);
    return write();
  }

  Status dispose(const T& last) override {
    if (const data::Refusal refusal = data::validate(last)) return refused(kRow, *refusal);
    const std::lock_guard lock(mutex_);
    codec::fast::to_wire(last, wire_);
    has_sample_ = false;
    // With autodispose, the default, readers see a dispose; and the instance leaves the writer's history,
    // which a dispose alone would let grow up to max_instances.
    if (writer_->unregister_instance(&wire_, eprosima::fastrtps::rtps::c_InstanceHandle_Unknown) !=
        ReturnCode_t::RETCODE_OK) {
      return internal_error("Fast DDS does not dispose the " + std::string(kRow.name) + " instance.");
    }
    return {};
  }

  void assert_liveliness() override {
    if constexpr (kRow.lease_ms > 0) {
      const std::lock_guard lock(mutex_);
      const bool was_lost = Clock::now() - asserted_ > std::chrono::milliseconds(kRow.lease_ms);
      if (was_lost && has_sample_) {
        (void)write();  // readers took the instance for dead, and only a sample revives it
        return;
      }
      writer_->assert_liveliness();
      asserted_ = Clock::now();
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr const TopicQos& kRow = TopicOf<T>::qos;

  FastPublisher(std::shared_ptr<Participant> participant, std::unique_ptr<WriterEvents> events,
                eprosima::fastdds::dds::DataWriter* writer)
      : participant_(std::move(participant)), events_(std::move(events)), writer_(writer) {}

  Status write() {
    asserted_ = Clock::now();
    if (!writer_->write(&wire_)) {
      return internal_error("Fast DDS does not write the " + std::string(kRow.name) + " sample.");
    }
    has_sample_ = true;
    return {};
  }

  const std::shared_ptr<Participant> participant_;
  const std::unique_ptr<WriterEvents> events_;
  eprosima::fastdds::dds::DataWriter* const writer_;
  std::mutex mutex_;
  typename WireOf<T>::Wire wire_;  ///< what was written last; its memory is reused
  bool has_sample_ = false;
  Clock::time_point asserted_ = Clock::now();
};

}  // namespace swallowtail::fast
