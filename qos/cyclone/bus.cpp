#include "qos/cyclone/bus.hpp"

#include <mutex>
#include <utility>
#include <vector>

#include "qos/cyclone/publisher.hpp"
#include "qos/cyclone/subscription.hpp"
#include "qos/endpoints.hpp"

namespace swallowtail {

namespace {

class CycloneBus final : public BusOfAllTopics<CycloneBus> {
 public:
  explicit CycloneBus(std::unique_ptr<cyclone::Participant> participant)
      : participant_(std::move(participant)) {}

  template <class T>
  Result<std::unique_ptr<Publisher<T>>> open_publisher(const PublisherOptions& options) {
    return cyclone::CyclonePublisher<T>::open(participant_, counters_, options);
  }

  template <class T>
  Status open_subscription(Handlers<T> handlers) {
    auto subscription = cyclone::CycloneSubscription<T>::open(*participant_, counters_, std::move(handlers));
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
  const std::shared_ptr<cyclone::Participant>
      participant_;  // shared with publishers: one that outlives the bus by mistake stays harmless
  const std::shared_ptr<Counters> counters_ = std::make_shared<Counters>();
  std::mutex mutex_;
  std::vector<std::unique_ptr<cyclone::AnySubscription>> subscriptions_;
};

}  // namespace

Result<std::unique_ptr<Bus>> make_cyclone_bus(const BusOptions& options) {
  auto participant = cyclone::Participant::create(options);
  if (!participant) return participant.error();
  return std::unique_ptr<Bus>(std::make_unique<CycloneBus>(std::move(*participant)));
}

}  // namespace swallowtail
