#include "tools/record/mcap/decode.hpp"

#include "tools/record/mcap/checksum.hpp"
#include "tools/record/mcap/compression.hpp"

namespace swallowtail::mcap {
namespace {

template <class T>
Result<T> checked(const ByteSource& source, T value, const char* kind) {
  if (source.failed()) return bad_input(std::string("A ") + kind + " record ends before its last field.");
  return value;
}

}  // namespace

std::optional<RecordView> take_record(ByteSource& source) {
  if (source.left() < kRecordHeaderBytes) return std::nullopt;
  const auto op = static_cast<Op>(source.take<std::uint8_t>());
  const auto length = source.take<std::uint64_t>();
  if (length > source.left()) return std::nullopt;
  return RecordView{op, source.take_bytes(length)};
}

Result<Schema> parse_schema(std::span<const std::byte> content) {
  ByteSource in(content);
  Schema schema;
  schema.id = in.take<std::uint16_t>();
  schema.name = in.take_string();
  schema.encoding = in.take_string();
  schema.data = in.take_string();
  if (!in.failed() && schema.id == 0) return bad_input("A schema has the id 0, which means none.");
  return checked(in, std::move(schema), "schema");
}

Result<Channel> parse_channel(std::span<const std::byte> content) {
  ByteSource in(content);
  Channel channel;
  channel.id = in.take<std::uint16_t>();
  channel.schema_id = in.take<std::uint16_t>();
  channel.topic = in.take_string();
  channel.message_encoding = in.take_string();
  channel.metadata = in.take_string_map();
  return checked(in, std::move(channel), "channel");
}

Result<Message> parse_message(std::span<const std::byte> content) {
  ByteSource in(content);
  Message message;
  message.channel_id = in.take<std::uint16_t>();
  message.sequence = in.take<std::uint32_t>();
  message.log_time_ns = in.take<std::uint64_t>();
  message.publish_time_ns = in.take<std::uint64_t>();
  message.data = in.rest();
  return checked(in, message, "message");
}

Result<Metadata> parse_metadata(std::span<const std::byte> content) {
  ByteSource in(content);
  Metadata metadata;
  metadata.name = in.take_string();
  metadata.entries = in.take_string_map();
  return checked(in, std::move(metadata), "metadata");
}

Result<MetadataIndex> parse_metadata_index(std::span<const std::byte> content) {
  ByteSource in(content);
  MetadataIndex index;
  index.offset = in.take<std::uint64_t>();
  index.length = in.take<std::uint64_t>();
  index.name = in.take_string();
  return checked(in, std::move(index), "metadata index");
}

Result<ChunkView> parse_chunk(std::span<const std::byte> content) {
  ByteSource in(content);
  ChunkView chunk;
  chunk.start_ns = in.take<std::uint64_t>();
  chunk.end_ns = in.take<std::uint64_t>();
  chunk.uncompressed_size = in.take<std::uint64_t>();
  chunk.crc = in.take<std::uint32_t>();
  chunk.compression = in.take_string();
  chunk.packed = in.take_bytes(in.take<std::uint64_t>());
  if (!in.failed() && chunk.start_ns > chunk.end_ns) return bad_input("A chunk ends before it starts.");
  return checked(in, std::move(chunk), "chunk");
}

Result<ChunkIndex> parse_chunk_index(std::span<const std::byte> content) {
  ByteSource in(content);
  ChunkIndex index;
  index.start_ns = in.take<std::uint64_t>();
  index.end_ns = in.take<std::uint64_t>();
  index.chunk_offset = in.take<std::uint64_t>();
  index.chunk_length = in.take<std::uint64_t>();
  index.message_index_offsets = in.take_map<std::uint16_t, std::uint64_t>();
  index.message_index_length = in.take<std::uint64_t>();
  index.compression = in.take_string();
  index.compressed_size = in.take<std::uint64_t>();
  index.uncompressed_size = in.take<std::uint64_t>();
  return checked(in, std::move(index), "chunk index");
}

Result<Statistics> parse_statistics(std::span<const std::byte> content) {
  ByteSource in(content);
  Statistics statistics;
  statistics.messages = in.take<std::uint64_t>();
  statistics.schemas = in.take<std::uint16_t>();
  statistics.channels = in.take<std::uint32_t>();
  statistics.attachments = in.take<std::uint32_t>();
  statistics.metadata = in.take<std::uint32_t>();
  statistics.chunks = in.take<std::uint32_t>();
  statistics.start_ns = in.take<std::uint64_t>();
  statistics.end_ns = in.take<std::uint64_t>();
  statistics.messages_by_channel = in.take_map<std::uint16_t, std::uint64_t>();
  return checked(in, std::move(statistics), "statistics");
}

Result<std::vector<std::byte>> unpack_chunk(const ChunkView& chunk, std::uint64_t max_bytes) {
  if (chunk.uncompressed_size > max_bytes) {
    return bad_input("A chunk says that it holds " + std::to_string(chunk.uncompressed_size) +
                     " bytes; at most " + std::to_string(max_bytes) + " are read.");
  }
  auto records = unpack(chunk.compression, chunk.packed, static_cast<std::size_t>(chunk.uncompressed_size));
  if (records && chunk.crc != 0 && crc32(*records) != chunk.crc)
    return bad_input("A chunk's CRC does not fit its bytes.");
  return records;
}

}  // namespace swallowtail::mcap
