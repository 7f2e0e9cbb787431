#pragma once

#include <memory>

#include "qos/bus.hpp"

namespace swallowtail {

/// A network inside one process, for tests. Buses of one network see each other; each may be used from any
/// thread. Delivery is synchronous: a publisher's call returns when the handlers have run (or, when another
/// thread is just delivering to the same subscription, have been handed to it); no lock is held meanwhile,
/// and the handlers of one subscription never run at the same time. Late joiners get what is latched,
/// ownership goes by strength, and a publisher that is destroyed takes its samples along. Deadlines,
/// lifespans and liveliness do not exist here.
class MemoryNetwork {
 public:
  MemoryNetwork();
  ~MemoryNetwork();
  MemoryNetwork(const MemoryNetwork&) = delete;
  MemoryNetwork& operator=(const MemoryNetwork&) = delete;

  /// The bus may outlive the network object.
  std::unique_ptr<Bus> make_bus();

  struct State;

 private:
  std::shared_ptr<State> state_;
};

}  // namespace swallowtail
