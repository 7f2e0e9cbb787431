#pragma once

#include <cstdint>
#include <string>

namespace swallowtail {

/// Domains above this have no ports: 7400 + 250 * domain ends at 65535.
inline constexpr std::uint32_t kMaxDomain = 232;

struct BusOptions {
  std::uint32_t domain = 0;
  std::string participant_name = "swallowtail";  ///< as shown by discovery tools
};

}  // namespace swallowtail
