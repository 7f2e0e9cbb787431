#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace swallowtail::mcap {

/// CRC-32 (polynomial 0xEDB88320) of `bytes`, going on from `crc`; 0 starts a new one.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t crc = 0);

}  // namespace swallowtail::mcap
