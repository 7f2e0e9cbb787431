#include <algorithm>

#include "tools/record/mcap/decode.hpp"
#include "tools/record/mcap/reader.hpp"

/// Reading a file from its start, without its summary.
namespace swallowtail::mcap {
namespace {

constexpr std::uint64_t kMaxLooseRunBytes = 4u << 20;

std::string at_byte(std::uint64_t offset) { return " (byte " + std::to_string(offset) + ")"; }

}  // namespace

void Reader::scan() {
  std::uint64_t offset = kMagic.size();
  while (offset < file_.size()) {
    std::array<std::byte, kRecordHeaderBytes> header{};
    if (file_.size() - offset < header.size() || !file_.read(offset, header)) {
      problems_.push_back("The file breaks off inside a record" + at_byte(offset) + ".");
      return;
    }
    ByteSource in(header);
    const auto op = static_cast<Op>(in.take<std::uint8_t>());
    const auto length = in.take<std::uint64_t>();
    if (length > file_.size() - offset - header.size()) {
      problems_.push_back("The file breaks off inside a record" + at_byte(offset) + ".");
      return;
    }
    if (op == Op{0}) {
      problems_.push_back("A record has the kind 0, which does not exist" + at_byte(offset) + ".");
      return;
    }
    if (op == Op::kDataEnd || op == Op::kFooter) return;
    if (const Status scanned = scan_record(op, offset, length); !scanned) {
      problems_.push_back(scanned.error().message + at_byte(offset));
    }
    offset += header.size() + length;
  }
}

Status Reader::scan_record(Op op, std::uint64_t offset, std::uint64_t content_length) {
  if (op == Op::kChunk) return scan_chunk(offset, content_length);
  if (op == Op::kMessage) return add_loose_message(offset, content_length);
  if (op != Op::kSchema && op != Op::kChannel && op != Op::kMetadata) return {};
  const auto content = read_bytes(offset + kRecordHeaderBytes, content_length, limits_.max_chunk_bytes);
  if (!content) return content.error();
  if (op == Op::kSchema) {
    auto schema = parse_schema(*content);
    return schema ? add_schema(std::move(*schema)) : Status(schema.error());
  }
  if (op == Op::kChannel) {
    auto channel = parse_channel(*content);
    return channel ? add_channel(std::move(*channel)) : Status(channel.error());
  }
  auto metadata = parse_metadata(*content);
  if (!metadata) return metadata.error();
  metadata_.push_back(std::move(*metadata));
  return {};
}

/// Takes up a chunk as a region to read, and the schemas and channels in it. A damaged one stays a region, so
/// that reading meets and counts it.
Status Reader::scan_chunk(std::uint64_t offset, std::uint64_t content_length) {
  const auto content = read_bytes(offset + kRecordHeaderBytes, content_length, limits_.max_chunk_bytes);
  if (!content) return content.error();
  const auto chunk = parse_chunk(*content);
  regions_.push_back({chunk ? chunk->start_ns : 0, chunk ? chunk->end_ns : 0, offset,
                      kRecordHeaderBytes + content_length, true});
  if (!chunk) return chunk.error();
  const auto records = unpack_chunk(*chunk, limits_.max_chunk_bytes);
  if (!records) return records.error();
  ByteSource source(*records);
  while (const auto record = take_record(source)) {
    if (record->op == Op::kSchema) {
      auto schema = parse_schema(record->content);
      if (!schema) return schema.error();
      if (const Status added = add_schema(std::move(*schema)); !added) return added;
    } else if (record->op == Op::kChannel) {
      auto channel = parse_channel(record->content);
      if (!channel) return channel.error();
      if (const Status added = add_channel(std::move(*channel)); !added) return added;
    }
  }
  return {};
}

Status Reader::add_loose_message(std::uint64_t offset, std::uint64_t content_length) {
  std::array<std::byte, kMessageHeaderBytes> head{};
  if (content_length < head.size()) return bad_input("A message record ends before its last field.");
  if (const Status read = file_.read(offset + kRecordHeaderBytes, head); !read) return read;
  const auto message = parse_message(head);
  if (!message) return message.error();
  const std::uint64_t length = kRecordHeaderBytes + content_length;
  const std::uint64_t time_ns = message->log_time_ns;
  if (!regions_.empty()) {
    Region& last = regions_.back();
    if (!last.is_chunk && last.offset + last.length == offset && last.length + length <= kMaxLooseRunBytes) {
      last.start_ns = std::min(last.start_ns, time_ns);
      last.end_ns = std::max(last.end_ns, time_ns);
      last.length += length;
      return {};
    }
  }
  regions_.push_back({time_ns, time_ns, offset, length, false});
  return {};
}

}  // namespace swallowtail::mcap
