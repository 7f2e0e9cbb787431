#include "tools/record/mcap/encode.hpp"

namespace swallowtail::mcap {

void put_record(ByteSink& out, const Schema& schema) {
  const auto record = out.begin_record(Op::kSchema);
  out.put(schema.id);
  out.put(std::string_view(schema.name));
  out.put(std::string_view(schema.encoding));
  out.put(std::string_view(schema.data));
  out.end_record(record);
}

void put_record(ByteSink& out, const Channel& channel) {
  const auto record = out.begin_record(Op::kChannel);
  out.put(channel.id);
  out.put(channel.schema_id);
  out.put(std::string_view(channel.topic));
  out.put(std::string_view(channel.message_encoding));
  out.put(channel.metadata);
  out.end_record(record);
}

void put_record(ByteSink& out, const Message& message) {
  out.put(Op::kMessage);
  out.put(static_cast<std::uint64_t>(kMessageHeaderBytes + message.data.size()));
  out.put(message.channel_id);
  out.put(message.sequence);
  out.put(message.log_time_ns);
  out.put(message.publish_time_ns);
  out.put_bytes(message.data);
}

void put_record(ByteSink& out, const Metadata& metadata) {
  const auto record = out.begin_record(Op::kMetadata);
  out.put(std::string_view(metadata.name));
  out.put(metadata.entries);
  out.end_record(record);
}

void put_record(ByteSink& out, const MetadataIndex& index) {
  const auto record = out.begin_record(Op::kMetadataIndex);
  out.put(index.offset);
  out.put(index.length);
  out.put(std::string_view(index.name));
  out.end_record(record);
}

void put_record(ByteSink& out, const ChunkIndex& index) {
  const auto record = out.begin_record(Op::kChunkIndex);
  out.put(index.start_ns);
  out.put(index.end_ns);
  out.put(index.chunk_offset);
  out.put(index.chunk_length);
  out.put(index.message_index_offsets);
  out.put(index.message_index_length);
  out.put(std::string_view(index.compression));
  out.put(index.compressed_size);
  out.put(index.uncompressed_size);
  out.end_record(record);
}

void put_record(ByteSink& out, const Statistics& statistics) {
  const auto record = out.begin_record(Op::kStatistics);
  out.put(statistics.messages);
  out.put(statistics.schemas);
  out.put(statistics.channels);
  out.put(statistics.attachments);
  out.put(statistics.metadata);
  out.put(statistics.chunks);
  out.put(statistics.start_ns);
  out.put(statistics.end_ns);
  out.put(statistics.messages_by_channel);
  out.end_record(record);
}

}  // namespace swallowtail::mcap
