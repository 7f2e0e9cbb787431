#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "planner/base/result.hpp"

namespace swallowtail::mcap {

enum class Compression { kNone, kZstd, kLz4 };

/// The name that a chunk carries: "", "zstd" or "lz4".
std::string_view compression_name(Compression compression);

/// Whether this build can write and read `compression` (LZ4 is optional).
bool is_supported(Compression compression);

/// Packs chunks; keeps its working memory from one to the next.
class Compressor {
 public:
  /// `zstd_level` 1 … 19.
  Compressor(Compression compression, int zstd_level);
  ~Compressor();
  Compressor(Compressor&&) noexcept;
  Compressor& operator=(Compressor&&) noexcept;

  /// Replaces `packed` by the compressed `records`.
  Status pack(std::span<const std::byte> records, std::vector<std::byte>& packed);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What a chunk's packed bytes hold. Fails unless that is exactly `uncompressed_size` bytes; the caller
/// bounds that size.
Result<std::vector<std::byte>> unpack(std::string_view compression, std::span<const std::byte> packed,
                                      std::size_t uncompressed_size);

}  // namespace swallowtail::mcap
