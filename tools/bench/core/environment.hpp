#pragma once

#include <string>
#include <utility>
#include <vector>

namespace swallowtail::bench {

/// Where and with what figures were measured: (name, value), such as ("processor", "…"), ("compiler", "…"),
/// ("revision", "…").
using Environment = std::vector<std::pair<std::string, std::string>>;

/// Processor, cores, operating system, compiler, build type, version and revision of this program.
Environment this_environment();

/// Name of the processor as /proc/cpuinfo's text says it; "unknown" where it does not.
std::string processor_of(const std::string& cpuinfo);

}  // namespace swallowtail::bench
