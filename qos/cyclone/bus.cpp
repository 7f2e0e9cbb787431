#include "qos/cyclone/bus.hpp"

#include "qos/cyclone/publisher.hpp"
#include "qos/cyclone/subscription.hpp"
#include "qos/vendor_bus.hpp"

namespace swallowtail {
namespace {

struct Vendor {
  using Participant = cyclone::Participant;
  using AnySubscription = cyclone::AnySubscription;
  template <class T>
  using Publisher = cyclone::CyclonePublisher<T>;
  template <class T>
  using Subscription = cyclone::CycloneSubscription<T>;
};

}  // namespace

Result<std::unique_ptr<Bus>> make_cyclone_bus(const BusOptions& options) {
  return VendorBus<Vendor>::open(options);
}

}  // namespace swallowtail
