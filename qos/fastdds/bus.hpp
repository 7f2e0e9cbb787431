#pragma once

#include <memory>

#include "planner/base/result.hpp"
#include "qos/bus.hpp"
#include "qos/options.hpp"

namespace swallowtail {

/// A Fast DDS participant on the loopback. Its participant profile is compiled in (qos/profiles/fastdds.xml)
/// unless FASTRTPS_DEFAULT_PROFILES_FILE names another file. SWALLOWTAIL_TRANSPORT is `udp` (the default:
/// nothing a killed process could leave behind) or `shm` (UDP and shared memory). Errors: a domain above
/// kMaxDomain, another transport name, a profile that cannot be read, no free port.
Result<std::unique_ptr<Bus>> make_fast_bus(const BusOptions& options);

}  // namespace swallowtail
