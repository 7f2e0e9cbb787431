#include "qos/fastdds/bus.hpp"

#include "qos/fastdds/publisher.hpp"
#include "qos/fastdds/subscription.hpp"
#include "qos/vendor_bus.hpp"

namespace swallowtail {
namespace {

struct Vendor {
  using Participant = fast::Participant;
  using AnySubscription = fast::AnySubscription;
  template <class T>
  using Publisher = fast::FastPublisher<T>;
  template <class T>
  using Subscription = fast::FastSubscription<T>;
};

}  // namespace

Result<std::unique_ptr<Bus>> make_fast_bus(const BusOptions& options) {
  return VendorBus<Vendor>::open(options);
}

}  // namespace swallowtail
