#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "tools/record/mcap/file.hpp"
#include "tools/record/mcap/records.hpp"

namespace swallowtail::mcap {

struct ReaderLimits {
  std::uint64_t max_chunk_bytes = std::uint64_t{1}
                                  << 29;  ///< packed or unpacked: what one chunk may make us hold
  std::uint64_t max_summary_bytes = std::uint64_t{1} << 29;
};

/// What to do with a chunk whose bytes are not what was written: end the reading with an error, or go on
/// after it.
enum class OnDamage { kFail, kSkip };

/// Reads one MCAP file, whole or cut off anywhere; every field of it is checked before it is used.
class Reader {
 public:
  /// kComplete: footer and summary stand and agree. kRecovered: they do not (the writer died, the file was
  /// cut or damaged), and the file was read from its start up to its last whole record.
  enum class Condition { kComplete, kRecovered };

  /// Fails where the file cannot be read or does not start as an MCAP file.
  static Result<Reader> open(const std::filesystem::path& path, const ReaderLimits& limits = {});

  Condition condition() const { return condition_; }
  /// Sentences about what was wrong with the file; empty for a file without fault.
  const std::vector<std::string>& problems() const { return problems_; }

  const std::vector<Schema>& schemas() const { return schemas_; }
  const std::vector<Channel>& channels() const { return channels_; }
  const std::vector<Metadata>& metadata() const { return metadata_; }
  /// Null where no such schema stands in the file (0 never does).
  const Schema* find_schema(std::uint16_t id) const;
  const Channel* find_channel(std::uint16_t id) const;
  /// What the writer counted; nothing for a recovered file.
  const std::optional<Statistics>& statistics() const { return statistics_; }

  using MessageFunction = std::function<void(const Channel&, const Message&)>;
  /// Calls `function` for every message in order of log time; equal times in order of writing. Holds only the
  /// chunks whose times overlap. Returns the number of damaged chunks left out (0 unless kSkip).
  Result<std::uint64_t> for_each_message(const MessageFunction& function,
                                         OnDamage on_damage = OnDamage::kFail) const;

 private:
  /// A run of message records in the file: a chunk, or messages that stand outside chunks.
  struct Region {
    std::uint64_t start_ns = 0;
    std::uint64_t end_ns = 0;
    std::uint64_t offset = 0;  ///< of the chunk record, or of the run's first message record
    std::uint64_t length = 0;
    bool is_chunk = true;
  };
  class Cursor;
  class Merge;

  Reader(InputFile file, const ReaderLimits& limits) : file_(std::move(file)), limits_(limits) {}
  Status read_summary();
  Status take_summary_records(std::span<const std::byte> summary,
                              std::vector<MetadataIndex>& metadata_indexes);
  Status check_summary() const;
  Status add_chunk(const ChunkIndex& index);
  Status load_metadata(const MetadataIndex& index);
  void forget();
  void scan();
  Status scan_record(Op op, std::uint64_t offset, std::uint64_t content_length);
  Status scan_chunk(std::uint64_t offset, std::uint64_t content_length);
  Status add_loose_message(std::uint64_t offset, std::uint64_t content_length);
  Status add_schema(Schema schema);
  Status add_channel(Channel channel);
  Result<std::vector<std::byte>> read_bytes(std::uint64_t offset, std::uint64_t length,
                                            std::uint64_t max) const;
  Result<std::vector<std::byte>> load(const Region& region) const;

  InputFile file_;
  ReaderLimits limits_;
  Condition condition_ = Condition::kComplete;
  std::vector<std::string> problems_;
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::vector<Metadata> metadata_;
  std::optional<Statistics> statistics_;
  std::vector<Region> regions_;
};

}  // namespace swallowtail::mcap
