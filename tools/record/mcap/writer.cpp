#include "tools/record/mcap/writer.hpp"

#include <algorithm>
#include <limits>

#include "tools/record/mcap/checksum.hpp"
#include "tools/record/mcap/encode.hpp"

namespace swallowtail::mcap {
namespace {

constexpr std::size_t kMaxIds = std::numeric_limits<std::uint16_t>::max();
constexpr std::uint64_t kMaxMessageBytes = std::uint64_t{1} << 28;

void put_magic(ByteSink& out) { out.put_bytes(std::as_bytes(std::span(kMagic))); }

}  // namespace

Status WriterParams::validate() const {
  if (!is_supported(compression))
    return bad_input("This build has no LZ4: choose zstd or none as the compression.");
  if (zstd_level < 1 || zstd_level > 19)
    return bad_input("zstd_level is " + std::to_string(zstd_level) + "; it must be in 1 … 19.");
  if (chunk_bytes < 1024 || chunk_bytes > (1u << 28)) {
    return bad_input("chunk_bytes is " + std::to_string(chunk_bytes) + "; it must be in 1024 … 268435456.");
  }
  if (chunk_span_ns == 0) return bad_input("chunk_span_ns is 0; it must be positive.");
  return {};
}

Writer::Writer(OutputFile file, const WriterParams& params)
    : file_(std::move(file)), params_(params), compressor_(params.compression, params.zstd_level) {
  chunk_.reserve(params.chunk_bytes + params.chunk_bytes / 4);
}

Writer::~Writer() {
  if (file_.is_open()) static_cast<void>(finish());
}

Result<Writer> Writer::create(const std::filesystem::path& path, const WriterParams& params) {
  if (const Status valid = params.validate(); !valid) return valid.error();
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  Writer writer(std::move(*file), params);
  if (const Status started = writer.start(); !started) return started.error();
  return writer;
}

Status Writer::start() {
  ByteSink out;
  put_magic(out);
  const auto record = out.begin_record(Op::kHeader);
  out.put(std::string_view());
  out.put(std::string_view(params_.library));
  out.end_record(record);
  return append(out);
}

Status Writer::append(const ByteSink& records) {
  if (!failure_) return failure_;
  failure_ = file_.append(records.bytes());
  if (!failure_) return failure_;
  if (params_.data_section_crc) data_crc_ = crc32(records.bytes(), data_crc_);
  if (params_.durability == Durability::kDisk) failure_ = file_.sync();
  return failure_;
}

Result<std::uint16_t> Writer::add_schema(std::string name, std::string encoding, std::string data) {
  if (schemas_.size() >= kMaxIds) return bad_input("An MCAP file cannot hold more than 65535 schemas.");
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back({id, std::move(name), std::move(encoding), std::move(data)});
  schema_announced_.push_back(0);
  ++statistics_.schemas;
  return id;
}

Result<std::uint16_t> Writer::add_channel(std::uint16_t schema_id, std::string topic,
                                          std::string message_encoding, StringMap metadata) {
  if (channels_.size() >= kMaxIds) return bad_input("An MCAP file cannot hold more than 65535 channels.");
  if (schema_id > schemas_.size()) {
    return bad_input("Channel \"" + topic + "\" names schema " + std::to_string(schema_id) +
                     ", which has not been added.");
  }
  const auto id = static_cast<std::uint16_t>(channels_.size());
  channels_.push_back({id, schema_id, std::move(topic), std::move(message_encoding), std::move(metadata)});
  channel_announced_.push_back(0);
  chunk_entries_.emplace_back();
  ++statistics_.channels;
  return id;
}

/// A channel's record, and its schema's, stand in the first chunk that needs them: what survives a crash
/// reads alone.
void Writer::announce(std::uint16_t channel_id) {
  if (channel_announced_[channel_id] != 0) return;
  const Channel& channel = channels_[channel_id];
  if (channel.schema_id != 0 && schema_announced_[channel.schema_id - 1u] == 0) {
    put_record(chunk_, schemas_[channel.schema_id - 1u]);
    schema_announced_[channel.schema_id - 1u] = 1;
  }
  put_record(chunk_, channel);
  channel_announced_[channel_id] = 1;
}

Status Writer::write(const Message& message) {
  if (!failure_) return failure_;
  if (finished_) return internal_error("A message came after the file had been finished.");
  if (message.channel_id >= channels_.size()) {
    return bad_input("A message names channel " + std::to_string(message.channel_id) +
                     ", which has not been added.");
  }
  if (message.data.size() > kMaxMessageBytes) return bad_input("A message is larger than 256 MiB.");
  announce(message.channel_id);
  chunk_start_ns_ =
      chunk_messages_ == 0 ? message.log_time_ns : std::min(chunk_start_ns_, message.log_time_ns);
  chunk_end_ns_ = chunk_messages_ == 0 ? message.log_time_ns : std::max(chunk_end_ns_, message.log_time_ns);
  chunk_entries_[message.channel_id].emplace_back(message.log_time_ns, chunk_.size());
  put_record(chunk_, message);
  ++chunk_messages_;
  if (chunk_.size() >= params_.chunk_bytes || chunk_end_ns_ - chunk_start_ns_ >= params_.chunk_span_ns)
    return flush();
  return {};
}

Status Writer::write_metadata(const Metadata& metadata) {
  if (!failure_) return failure_;
  if (finished_) return internal_error("Metadata came after the file had been finished.");
  ByteSink out;
  put_record(out, metadata);
  MetadataIndex index{file_.size(), out.size(), metadata.name};
  const Status appended = append(out);
  if (appended) {
    metadata_.push_back(std::move(index));
    ++statistics_.metadata;
  }
  return appended;
}

void Writer::put_message_indexes(ByteSink& out, std::uint64_t offset, ChunkIndex& index) {
  const std::size_t start = out.size();
  for (std::size_t channel = 0; channel < chunk_entries_.size(); ++channel) {
    auto& entries = chunk_entries_[channel];
    if (entries.empty()) continue;
    const auto id = static_cast<std::uint16_t>(channel);
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    index.message_index_offsets[id] = offset + out.size();
    const auto record = out.begin_record(Op::kMessageIndex);
    out.put(id);
    out.put(static_cast<std::uint32_t>(entries.size() * 16));
    for (const auto& [time, at] : entries) {
      out.put(time);
      out.put(at);
    }
    out.end_record(record);
    statistics_.messages_by_channel[id] += entries.size();
    entries.clear();
  }
  index.message_index_length = out.size() - start;
}

Status Writer::flush() {
  if (!failure_ || chunk_.empty()) return failure_;
  if (const Status packed = compressor_.pack(chunk_.bytes(), packed_); !packed) return failure_ = packed;
  const bool is_smaller = packed_.size() < chunk_.size();
  const std::span<const std::byte> stored = is_smaller ? std::span<const std::byte>(packed_) : chunk_.bytes();
  ChunkIndex index{.start_ns = chunk_start_ns_,
                   .end_ns = chunk_end_ns_,
                   .chunk_offset = file_.size(),
                   .compression = std::string(is_smaller ? compression_name(params_.compression) : ""),
                   .compressed_size = stored.size(),
                   .uncompressed_size = chunk_.size()};
  block_.clear();
  const auto record = block_.begin_record(Op::kChunk);
  block_.put(index.start_ns);
  block_.put(index.end_ns);
  block_.put(index.uncompressed_size);
  block_.put(crc32(chunk_.bytes()));
  block_.put(std::string_view(index.compression));
  block_.put(index.compressed_size);
  block_.put_bytes(stored);
  block_.end_record(record);
  index.chunk_length = block_.size();
  put_message_indexes(block_, index.chunk_offset, index);
  if (const Status appended = append(block_); !appended) return appended;

  const bool is_first = statistics_.messages == 0;
  statistics_.start_ns = is_first ? index.start_ns : std::min(statistics_.start_ns, index.start_ns);
  statistics_.end_ns = is_first ? index.end_ns : std::max(statistics_.end_ns, index.end_ns);
  statistics_.messages += chunk_messages_;
  ++statistics_.chunks;
  chunks_.push_back(std::move(index));
  chunk_.clear();
  chunk_messages_ = 0;
  return {};
}

Status Writer::write_data_end() {
  ByteSink out;
  const auto record = out.begin_record(Op::kDataEnd);
  out.put(data_crc_);
  out.end_record(record);
  return append(out);
}

void Writer::put_group(ByteSink& summary, ByteSink& offsets, Op op, const ByteSink& group) const {
  if (group.empty()) return;
  const auto record = offsets.begin_record(Op::kSummaryOffset);
  offsets.put(op);
  offsets.put(static_cast<std::uint64_t>(file_.size() + summary.size()));
  offsets.put(static_cast<std::uint64_t>(group.size()));
  offsets.end_record(record);
  summary.put_bytes(group.bytes());
}

Status Writer::write_summary() {
  ByteSink summary;
  ByteSink offsets;
  const auto add = [&](Op op, const auto& records) {
    ByteSink group;
    for (const auto& record : records) put_record(group, record);
    put_group(summary, offsets, op, group);
  };
  add(Op::kSchema, schemas_);
  add(Op::kChannel, channels_);
  add(Op::kStatistics, std::span(&statistics_, 1));
  add(Op::kChunkIndex, chunks_);
  add(Op::kMetadataIndex, metadata_);
  const std::uint64_t summary_start = file_.size();
  const std::uint64_t offsets_start = summary_start + summary.size();
  summary.put_bytes(offsets.bytes());
  summary.put(Op::kFooter);
  summary.put(static_cast<std::uint64_t>(kFooterContentBytes));
  summary.put(summary_start);
  summary.put(offsets_start);
  summary.put(crc32(summary.bytes()));
  put_magic(summary);
  return append(summary);
}

Status Writer::finish() {
  if (finished_) return failure_;
  if (const Status flushed = flush(); !flushed) return flushed;
  finished_ = true;
  if (const Status ended = write_data_end(); !ended) return ended;
  if (const Status summed = write_summary(); !summed) return summed;
  failure_ = file_.close();
  return failure_;
}

}  // namespace swallowtail::mcap
