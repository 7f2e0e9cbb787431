#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/base/result.hpp"
#include "tools/record/mcap/bytes.hpp"

/// Untrusted record contents, checked: what is returned holds only bytes that were there.
namespace swallowtail::mcap {

/// A record inside bytes already read.
struct RecordView {
  Op op{};
  std::span<const std::byte> content;
};

/// The next record of `source`, or nothing where no whole one is left.
std::optional<RecordView> take_record(ByteSource& source);

/// A chunk record's fields; `packed` points into the record.
struct ChunkView {
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t crc = 0;
  std::string compression;
  std::span<const std::byte> packed;
};

Result<Schema> parse_schema(std::span<const std::byte> content);
Result<Channel> parse_channel(std::span<const std::byte> content);
Result<Message> parse_message(std::span<const std::byte> content);
Result<Metadata> parse_metadata(std::span<const std::byte> content);
Result<MetadataIndex> parse_metadata_index(std::span<const std::byte> content);
Result<ChunkView> parse_chunk(std::span<const std::byte> content);
Result<ChunkIndex> parse_chunk_index(std::span<const std::byte> content);
Result<Statistics> parse_statistics(std::span<const std::byte> content);

/// The records of a chunk, unpacked and checked against size limit and CRC.
Result<std::vector<std::byte>> unpack_chunk(const ChunkView& chunk, std::uint64_t max_bytes);

}  // namespace swallowtail::mcap
