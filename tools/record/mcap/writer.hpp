#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/base/result.hpp"
#include "tools/record/mcap/bytes.hpp"
#include "tools/record/mcap/compression.hpp"
#include "tools/record/mcap/file.hpp"
#include "tools/record/mcap/records.hpp"

namespace swallowtail::mcap {

/// When a closed chunk counts as written: in the page cache (survives the process) or on the disk (survives
/// the machine).
enum class Durability { kPageCache, kDisk };

struct WriterParams {
  Compression compression = Compression::kZstd;
  int zstd_level = 1;                           ///< 1 … 19
  std::uint64_t chunk_bytes = 1u << 20;         ///< a chunk is closed once its records reach this many bytes
  std::uint64_t chunk_span_ns = 1'000'000'000;  ///< … or once its messages' log times are this far apart
  Durability durability = Durability::kPageCache;
  std::string library = "swallowtail";
  bool data_section_crc = false;

  Status validate() const;
};

/// Writes one MCAP file. Messages gather in a chunk; a closed chunk goes to the file with its index in one
/// write, so that a process which dies loses the open chunk and nothing else. The caller bounds that loss in
/// wall time with flush(). After a failed write every call returns that failure. Not thread-safe.
class Writer {
 public:
  static Result<Writer> create(const std::filesystem::path& path, const WriterParams& params = {});
  Writer(Writer&&) = default;
  Writer& operator=(Writer&&) = delete;
  /// Finishes the file where finish() has not been called; a failure is then lost.
  ~Writer();

  /// Returns the new schema's id. Fails past 65535 of them.
  Result<std::uint16_t> add_schema(std::string name, std::string encoding, std::string data);
  /// Returns the new channel's id. `schema_id` is 0 or one that add_schema gave.
  Result<std::uint16_t> add_channel(std::uint16_t schema_id, std::string topic, std::string message_encoding,
                                    StringMap metadata = {});
  Status write(const Message& message);
  Status write_metadata(const Metadata& metadata);
  /// Closes the open chunk, if it holds anything, and puts it in the file.
  Status flush();
  /// Flushes, writes summary and footer, and closes the file. Later calls do nothing.
  Status finish();

  const Statistics& statistics() const { return statistics_; }
  std::uint64_t file_bytes() const { return file_.size(); }
  bool chunk_is_open() const { return !chunk_.empty(); }

 private:
  using IndexEntry = std::pair<std::uint64_t, std::uint64_t>;  ///< log time, offset in the uncompressed chunk

  Writer(OutputFile file, const WriterParams& params);
  Status start();
  Status append(const ByteSink& records);
  void begin_chunk_if_needed(std::uint64_t log_time_ns);
  void announce(std::uint16_t channel_id);
  void put_message_indexes(ByteSink& out, std::uint64_t offset, ChunkIndex& index);
  Status write_data_end();
  Status write_summary();
  void put_group(ByteSink& summary, ByteSink& offsets, Op op, const ByteSink& group) const;

  OutputFile file_;
  WriterParams params_;
  Compressor compressor_;
  Status failure_;
  bool finished_ = false;
  std::uint32_t data_crc_ = 0;

  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::vector<char> schema_announced_;   ///< by id - 1: its record stands in some chunk
  std::vector<char> channel_announced_;  ///< by id
  std::vector<ChunkIndex> chunks_;
  std::vector<MetadataIndex> metadata_;
  Statistics statistics_;

  ByteSink chunk_;
  std::uint64_t chunk_messages_ = 0;
  std::uint64_t chunk_start_ns_ = 0;
  std::uint64_t chunk_end_ns_ = 0;
  std::vector<std::vector<IndexEntry>> chunk_entries_;  ///< by channel id
  std::vector<std::byte> packed_;
  ByteSink block_;
};

}  // namespace swallowtail::mcap
