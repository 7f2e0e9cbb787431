#include "qos/fastdds/bus.hpp"

#include <mutex>
#include <utility>
#include <vector>

#include "qos/endpoints.hpp"
#include "qos/fastdds/publisher.hpp"
#include "qos/fastdds/subscription.hpp"

namespace swallowtail {

namespace {

class FastBus final : public BusOfAllTopics<FastBus> {
 public:
  explicit FastBus(std::unique_ptr<fast::Participant> participant) : participant_(std::move(participant)) {}

  template <class T>
  Result<std::unique_ptr<Publisher<T>>> open_publisher(const PublisherOptions& options) {
    return fast::FastPublisher<T>::open(participant_, counters_, options);
  }

  template <class T>
  Status open_subscription(Handlers<T> handlers) {
    auto subscription = fast::FastSubscription<T>::open(*participant_, counters_, std::move(handlers));
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
  const std::shared_ptr<fast::Participant>
      participant_;  // shared with publishers: one that outlives the bus by mistake stays harmless
  const std::shared_ptr<Counters> counters_ = std::make_shared<Counters>();
  std::mutex mutex_;
  std::vector<std::unique_ptr<fast::AnySubscription>> subscriptions_;
};

}  // namespace

Result<std::unique_ptr<Bus>> make_fast_bus(const BusOptions& options) {
  auto participant = fast::Participant::create(options);
  if (!participant) return participant.error();
  return std::unique_ptr<Bus>(std::make_unique<FastBus>(std::move(*participant)));
}

}  // namespace swallowtail
