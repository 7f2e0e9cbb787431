#pragma once

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

namespace swallowtail::cyclone {

/// A reader of one topic: takes, decodes, validates, counts, and calls the handlers.
class AnySubscription {
 public:
  AnySubscription(std::shared_ptr<Counters> counters, const TopicQos& row)
      : row_(row), counters_(std::move(counters)) {}
  virtual ~AnySubscription() = default;
  AnySubscription(const AnySubscription&) = delete;
  AnySubscription& operator=(const AnySubscription&) = delete;

  virtual void drain(dds_entity_t reader) = 0;

  const TopicQos& row() const { return row_; }
  Counters& counters() { return *counters_; }

 private:
  const TopicQos& row_;
  const std::shared_ptr<Counters> counters_;
};

/// Calls `subscription` on the receiving thread.
Listener reader_events(AnySubscription* subscription);

template <class T>
class CycloneSubscription final : public AnySubscription {
 public:
  static Result<std::unique_ptr<AnySubscription>> open(Participant& participant,
                                                       std::shared_ptr<Counters> counters,
                                                       Handlers<T> handlers) {
    const std::string name = kRow.name;
    std::unique_ptr<CycloneSubscription> owner(
        new CycloneSubscription(std::move(counters), std::move(handlers)));
    auto topic = owned(
        dds_create_topic(participant.get(), &codec::cyclone::descriptor<Wire>(), kRow.name, nullptr, nullptr),
        "topic " + name);
    if (!topic) return topic.error();
    owner->topic_ = std::move(*topic);
    const Listener events = reader_events(owner.get());
    auto reader =
        owned(dds_create_reader(participant.get(), owner->topic_.get(), reader_qos(kRow).get(), events.get()),
              "reader of " + name);
    if (!reader) return reader.error();
    owner->reader_ = std::move(*reader);
    return std::unique_ptr<AnySubscription>(std::move(owner));
  }

  ~CycloneSubscription() override { reader_.reset(); }  // waits for a handler under way

  void drain(dds_entity_t reader) override {
    const std::lock_guard lock(mutex_);
    void* samples[1] = {wire_.get()};
    dds_sample_info_t info;
    while (dds_take(reader, samples, &info, 1, 1) > 0) {
      const bool gone = info.instance_state != DDS_IST_ALIVE;
      const bool disposed = info.instance_state == DDS_IST_NOT_ALIVE_DISPOSED;
      // The last sample of a writer that has left is news; that of one which disposed it, by write and
      // dispose in one, is not.
      if (info.valid_data && !disposed) accept();
      if (gone) report_gone();
    }
  }

 private:
  using Wire = typename WireOf<T>::Wire;
  static constexpr const TopicQos& kRow = TopicOf<T>::qos;

  CycloneSubscription(std::shared_ptr<Counters> counters, Handlers<T> handlers)
      : AnySubscription(std::move(counters), kRow), handlers_(std::move(handlers)) {}

  void accept() {
    data::Refusal refusal = codec::cyclone::to_data(*wire_, value_);
    if (!refusal) refusal = data::validate(value_);
    if (refusal) {
      counters().reject(kRow.name, *refusal);
      return;
    }
    counters().accept();
    if (handlers_.on_sample) handlers_.on_sample(value_);
  }

  /// The key fields are there without valid data, too.
  void report_gone() {
    if (!handlers_.on_gone) return;
    (void)codec::cyclone::to_data(*wire_, value_);
    handlers_.on_gone(TopicOf<T>::key(value_));
  }

  const Handlers<T> handlers_;
  Entity topic_;
  Entity reader_;
  std::mutex mutex_;
  codec::cyclone::Sample<Wire> wire_;
  T value_;
};

}  // namespace swallowtail::cyclone
