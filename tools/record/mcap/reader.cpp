#include "tools/record/mcap/reader.hpp"

#include <algorithm>
#include <cstring>

#include "tools/record/mcap/checksum.hpp"
#include "tools/record/mcap/decode.hpp"

namespace swallowtail::mcap {
namespace {

constexpr std::size_t kTailBytes = kRecordHeaderBytes + kFooterContentBytes + kMagic.size();

bool is_magic(std::span<const std::byte> bytes) {
  return bytes.size() == kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

}  // namespace

Result<Reader> Reader::open(const std::filesystem::path& path, const ReaderLimits& limits) {
  auto file = InputFile::open(path);
  if (!file) return file.error();
  std::array<std::byte, kMagic.size()> magic{};
  if (file->size() < magic.size())
    return bad_input(file->name() + " is no MCAP file: it has only " + std::to_string(file->size()) +
                     " bytes.");
  if (const Status read = file->read(0, magic); !read) return read.error();
  if (!is_magic(magic))
    return bad_input(file->name() + " is no MCAP file: it does not start with MCAP's magic bytes.");
  Reader reader(std::move(*file), limits);
  if (const Status summary = reader.read_summary(); !summary) {
    reader.forget();
    reader.condition_ = Condition::kRecovered;
    reader.problems_.push_back(summary.error().message);
    reader.scan();
  }
  const auto is_earlier = [](const Region& a, const Region& b) {
    return std::pair(a.start_ns, a.offset) < std::pair(b.start_ns, b.offset);
  };
  std::sort(reader.regions_.begin(), reader.regions_.end(), is_earlier);
  return reader;
}

const Schema* Reader::find_schema(std::uint16_t id) const {
  const auto found =
      std::find_if(schemas_.begin(), schemas_.end(), [id](const Schema& s) { return s.id == id; });
  return found == schemas_.end() ? nullptr : &*found;
}

const Channel* Reader::find_channel(std::uint16_t id) const {
  const auto found =
      std::find_if(channels_.begin(), channels_.end(), [id](const Channel& c) { return c.id == id; });
  return found == channels_.end() ? nullptr : &*found;
}

void Reader::forget() {
  schemas_.clear();
  channels_.clear();
  metadata_.clear();
  statistics_.reset();
  regions_.clear();
}

Result<std::vector<std::byte>> Reader::read_bytes(std::uint64_t offset, std::uint64_t length,
                                                  std::uint64_t max) const {
  if (length > max)
    return bad_input("A record of " + std::to_string(length) + " bytes is larger than the " +
                     std::to_string(max) + " that are read.");
  if (offset > file_.size() || length > file_.size() - offset)
    return bad_input("A record lies outside the file.");
  std::vector<std::byte> bytes(static_cast<std::size_t>(length));
  if (const Status read = file_.read(offset, bytes); !read) return read.error();
  return bytes;
}

Status Reader::add_schema(Schema schema) {
  const Schema* known = find_schema(schema.id);
  if (known == nullptr) {
    schemas_.push_back(std::move(schema));
  } else if (*known != schema) {
    return bad_input("Schema " + std::to_string(schema.id) + " stands in the file twice, and differs.");
  }
  return {};
}

Status Reader::add_channel(Channel channel) {
  const Channel* known = find_channel(channel.id);
  if (known == nullptr) {
    channels_.push_back(std::move(channel));
  } else if (*known != channel) {
    return bad_input("Channel " + std::to_string(channel.id) + " stands in the file twice, and differs.");
  }
  return {};
}

Status Reader::add_chunk(const ChunkIndex& index) {
  if (index.start_ns > index.end_ns) return bad_input("A chunk index ends before it starts.");
  if (index.chunk_length < kRecordHeaderBytes || index.chunk_offset > file_.size() ||
      index.chunk_length > file_.size() - index.chunk_offset) {
    return bad_input("A chunk index points outside the file.");
  }
  regions_.push_back({index.start_ns, index.end_ns, index.chunk_offset, index.chunk_length, true});
  return {};
}

Status Reader::load_metadata(const MetadataIndex& index) {
  const auto bytes = read_bytes(index.offset, index.length, limits_.max_chunk_bytes);
  if (!bytes) return bytes.error();
  ByteSource source(*bytes);
  const auto record = take_record(source);
  if (!record || record->op != Op::kMetadata)
    return bad_input("A metadata index does not point at metadata.");
  auto metadata = parse_metadata(record->content);
  if (!metadata) return metadata.error();
  metadata_.push_back(std::move(*metadata));
  return {};
}

Status Reader::take_summary_records(std::span<const std::byte> summary,
                                    std::vector<MetadataIndex>& metadata_indexes) {
  ByteSource source(summary);
  while (const auto record = take_record(source)) {
    Status taken;
    const auto take = [&](auto parsed, auto&& keep) {
      taken = parsed ? keep(std::move(*parsed)) : Status(parsed.error());
    };
    switch (record->op) {
      case Op::kSchema:
        take(parse_schema(record->content), [&](Schema s) { return add_schema(std::move(s)); });
        break;
      case Op::kChannel:
        take(parse_channel(record->content), [&](Channel c) { return add_channel(std::move(c)); });
        break;
      case Op::kChunkIndex:
        take(parse_chunk_index(record->content), [&](const ChunkIndex& i) { return add_chunk(i); });
        break;
      case Op::kStatistics:
        take(parse_statistics(record->content), [&](Statistics s) {
          statistics_ = std::move(s);
          return Status();
        });
        break;
      case Op::kMetadataIndex:
        take(parse_metadata_index(record->content), [&](MetadataIndex i) {
          metadata_indexes.push_back(std::move(i));
          return Status();
        });
        break;
      default:
        break;
    }
    if (!taken) return taken;
  }
  if (!source.at_end()) return bad_input("The summary's last record is not whole.");
  return {};
}

/// A summary may leave out what only a scan can find: then it is not enough to read by.
Status Reader::check_summary() const {
  if (!statistics_) return bad_input("The file's summary has no statistics.");
  if (statistics_->channels != channels_.size())
    return bad_input("The file's summary does not list every channel.");
  if (statistics_->chunks != regions_.size())
    return bad_input("The file's summary does not list every chunk.");
  if (statistics_->messages > 0 && regions_.empty())
    return bad_input("The file's messages are not in chunks.");
  return {};
}

Status Reader::read_summary() {
  if (file_.size() < kMagic.size() + kTailBytes) return bad_input("The file has no footer.");
  const std::uint64_t footer_offset = file_.size() - kTailBytes;
  std::array<std::byte, kTailBytes> tail{};
  if (const Status read = file_.read(footer_offset, tail); !read) return read;
  ByteSource in(tail);
  const auto op = static_cast<Op>(in.take<std::uint8_t>());
  const auto length = in.take<std::uint64_t>();
  const auto summary_start = in.take<std::uint64_t>();
  const auto offsets_start = in.take<std::uint64_t>();
  const auto crc = in.take<std::uint32_t>();
  if (op != Op::kFooter || length != kFooterContentBytes || !is_magic(in.rest()))
    return bad_input("The file has no footer.");
  if (summary_start == 0) return bad_input("The file has no summary.");
  const std::uint64_t summary_end = offsets_start == 0 ? footer_offset : offsets_start;
  if (summary_start < kMagic.size() || summary_start > summary_end || summary_end > footer_offset) {
    return bad_input("The footer points outside the file.");
  }
  const auto summary = read_bytes(summary_start, footer_offset - summary_start, limits_.max_summary_bytes);
  if (!summary) return summary.error();
  if (crc != 0 && crc32(std::span(tail).first(kRecordHeaderBytes + 16), crc32(*summary)) != crc) {
    return bad_input("The summary's CRC does not fit its bytes.");
  }
  std::vector<MetadataIndex> metadata_indexes;
  const auto records =
      std::span<const std::byte>(*summary).first(static_cast<std::size_t>(summary_end - summary_start));
  if (const Status taken = take_summary_records(records, metadata_indexes); !taken) return taken;
  for (const MetadataIndex& index : metadata_indexes) {
    if (const Status loaded = load_metadata(index); !loaded) return loaded;
  }
  return check_summary();
}

}  // namespace swallowtail::mcap
