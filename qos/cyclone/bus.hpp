#pragma once

#include <memory>

#include "planner/base/result.hpp"
#include "qos/bus.hpp"
#include "qos/options.hpp"

namespace swallowtail {

/// A Cyclone DDS participant on the loopback. Its configuration is compiled in (qos/profiles/cyclone.xml)
/// unless CYCLONEDDS_URI gives another. A write runs the handlers of readers in the same process on the
/// writer's thread. Errors: a domain above kMaxDomain, a configuration that Cyclone refuses, no free port.
Result<std::unique_ptr<Bus>> make_cyclone_bus(const BusOptions& options);

}  // namespace swallowtail
