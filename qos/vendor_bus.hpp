#pragma once

#include <memory>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "qos/endpoints.hpp"

namespace swallowtail {

/// The Bus over one vendor's participant. `Vendor` names the vendor's Participant, Publisher<T>,
/// Subscription<T> and AnySubscription.
template <class Vendor>
class VendorBus final : public BusOfAllTopics<VendorBus<Vendor>> {
 public:
  using Participant = typename Vendor::Participant;

  static Result<std::unique_ptr<Bus>> open(const BusOptions& options) {
    auto participant = Participant::create(options);
    if (!participant) return participant.error();
    return std::unique_ptr<Bus>(std::make_unique<VendorBus>(std::move(*participant)));
  }

  explicit VendorBus(std::unique_ptr<Participant> participant) : participant_(std::move(participant)) {}

  template <class T>
  Result<std::unique_ptr<Publisher<T>>> open_publisher(const PublisherOptions& options) {
    return Vendor::template Publisher<T>::open(participant_, counters_, options);
  }

  template <class T>
  Status open_subscription(Handlers<T> handlers) {
    auto subscription = Vendor::template Subscription<T>::open(*participant_, counters_, std::move(handlers));
    if (!subscription) return subscription.error();
    const std::lock_guard lock(mutex_);
    subscriptions_.push_back(std::move(*subscription));
    return {};
  }

  BusStatistics statistics() const override { return counters_->snapshot(); }
  void count_rejection(std::string_view topic, std::string_view reason) override {
    counters_->reject(topic, reason);
  }

 private:
  const std::shared_ptr<Participant>
      participant_;  // shared with publishers: one that outlives the bus by mistake stays harmless
  const std::shared_ptr<Counters> counters_ = std::make_shared<Counters>();
  std::mutex mutex_;
  std::vector<std::unique_ptr<typename Vendor::AnySubscription>> subscriptions_;
};

}  // namespace swallowtail
