#include "tools/record/mcap/checksum.hpp"

#include <zlib.h>

namespace swallowtail::mcap {

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t crc) {
  return static_cast<std::uint32_t>(
      ::crc32_z(crc, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace swallowtail::mcap
