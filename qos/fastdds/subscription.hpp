#pragma once

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <memory>
#include <mutex>
#include <utility>

#include "idl/data/validate.hpp"
#include "qos/bus.hpp"
#include "qos/counters.hpp"
#include "qos/fastdds/participant.hpp"
#include "qos/fastdds/qos.hpp"
#include "qos/fastdds/type.hpp"
#include "qos/fastdds/writers.hpp"

namespace swallowtail::fast {

/// A reader of one topic: takes, decodes, validates, counts, and calls the handlers.
class AnySubscription {
 public:
  virtual ~AnySubscription() = default;
};

template <class T>
class FastSubscription final : public AnySubscription, private eprosima::fastdds::dds::DataReaderListener {
 public:
  static Result<std::unique_ptr<AnySubscription>> open(Participant& participant,
                                                       std::shared_ptr<Counters> counters,
                                                       Handlers<T> handlers) {
    auto* topic = participant.topic(kRow, eprosima::fastdds::dds::TypeSupport(new Type<T>()));
    if (!topic) return internal_error("Fast DDS makes no topic " + std::string(kRow.name) + ".");
    std::unique_ptr<FastSubscription> owner(
        new FastSubscription(participant, std::move(counters), std::move(handlers)));
    owner->reader_ = participant.subscriber()->create_datareader(topic, reader_qos(kRow), owner.get());
    if (!owner->reader_) return internal_error("Fast DDS makes no reader of " + std::string(kRow.name) + ".");
    return std::unique_ptr<AnySubscription>(std::move(owner));
  }

  ~FastSubscription() override {
    if (!reader_) return;
    reader_->set_listener(nullptr);
    participant_.subscriber()->delete_datareader(reader_);
    const std::lock_guard lock(mutex_);  // a handler that was under way has returned
  }
  FastSubscription(const FastSubscription&) = delete;
  FastSubscription& operator=(const FastSubscription&) = delete;

 private:
  using Reader = eprosima::fastdds::dds::DataReader;
  static constexpr const TopicQos& kRow = TopicOf<T>::qos;

  FastSubscription(Participant& participant, std::shared_ptr<Counters> counters, Handlers<T> handlers)
      : participant_(participant), counters_(std::move(counters)), handlers_(std::move(handlers)) {}

  void on_data_available(Reader* reader) override {
    const std::lock_guard lock(mutex_);
    eprosima::fastdds::dds::SampleInfo info;
    while (reader->take_next_sample(&wire_, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) {
        accept(info.publication_handle);
      } else if (info.instance_state != eprosima::fastdds::dds::ALIVE_INSTANCE_STATE) {
        report_gone(info.instance_handle);
      }
    }
  }

  void on_subscription_matched(Reader* reader,
                               const eprosima::fastdds::dds::SubscriptionMatchedStatus& status) override {
    if (status.current_count_change >= 0) return;
    on_data_available(reader);  // what the writer said last
    const std::lock_guard lock(mutex_);
    end(status.current_count, status.last_publication_handle);
  }

  void on_liveliness_changed(Reader* reader,
                             const eprosima::fastrtps::LivelinessChangedStatus& status) override {
    if (kRow.lease_ms == 0 || status.alive_count_change >= 0) return;
    on_data_available(reader);
    const std::lock_guard lock(mutex_);
    end(status.alive_count, status.last_publication_handle);
  }

  /// A writer has left. Where ownership is exclusive the samples of the weaker ones were never seen here, so
  /// that an instance counts as gone only with the topic's last writer.
  void end(int writers_left, const Writers::Handle& writer) {
    if (!handlers_.on_gone || (kRow.ownership == Ownership::kExclusive && writers_left > 0)) return;
    for (const InstanceKey& key : writers_left > 0 ? writers_.leave(writer) : writers_.leave_all()) {
      handlers_.on_gone(key);
    }
  }

  void on_requested_deadline_missed(
      Reader*, const eprosima::fastrtps::RequestedDeadlineMissedStatus& status) override {
    counters_->miss_deadlines(static_cast<std::uint64_t>(status.total_count_change));
  }

  void on_requested_incompatible_qos(
      Reader*, const eprosima::fastdds::dds::RequestedIncompatibleQosStatus& status) override {
    counters_->meet_incompatible(static_cast<std::uint64_t>(status.total_count_change));
  }

  void on_sample_rejected(Reader*, const eprosima::fastrtps::SampleRejectedStatus& status) override {
    counters_->reject(kRow.name, "above the resource limits",
                      static_cast<std::uint64_t>(status.total_count_change));
  }

  void accept(const Writers::Handle& writer) {
    data::Refusal refusal = codec::fast::to_data(wire_, value_);
    if (!refusal) refusal = data::validate(value_);
    if (refusal) {
      counters_->reject(kRow.name, *refusal);
      return;
    }
    counters_->accept();
    if (handlers_.on_gone) writers_.wrote(TopicOf<T>::key(value_), writer);
    if (handlers_.on_sample) handlers_.on_sample(value_);
  }

  void report_gone(const eprosima::fastrtps::rtps::InstanceHandle_t& handle) {
    KeyBytes bytes{};
    for (unsigned i = 0; i < bytes.size(); ++i) bytes[i] = handle.value[i];
    const InstanceKey key = key_of(bytes, kRow.key_fields);
    writers_.forget(key);
    if (handlers_.on_gone) handlers_.on_gone(key);
  }

  Participant& participant_;
  const std::shared_ptr<Counters> counters_;
  const Handlers<T> handlers_;
  Reader* reader_ = nullptr;
  std::mutex mutex_;
  Writers writers_;
  typename WireOf<T>::Wire wire_;
  T value_;
};

}  // namespace swallowtail::fast
