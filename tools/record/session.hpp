#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "planner/base/result.hpp"
#include "qos/topics.hpp"
#include "tools/record/event.hpp"
#include "tools/record/mcap/writer.hpp"
#include "tools/record/queue.hpp"

namespace swallowtail::record {

struct SessionParams {
  mcap::WriterParams file;
  std::chrono::milliseconds flush_every{500};  ///< wall time: what a killed recorder loses at most
  std::size_t queue_bytes = std::size_t{256} << 20;
  std::size_t queue_events = 1'000'000;

  Status validate() const;
};

struct TopicCounters {
  std::uint64_t samples = 0;  ///< written to the file
  std::uint64_t lifecycle_events = 0;
  std::uint64_t dropped = 0;           ///< received, but the queue was full or the file had failed
  std::uint64_t lost = 0;              ///< DDS says that they never arrived
  std::uint64_t incompatible_qos = 0;  ///< writers which the reader does not fit
};

struct SessionSummary {
  std::vector<TopicCounters> topics;  ///< in the order of the session's topics
  std::uint64_t messages = 0;
  std::uint64_t file_bytes = 0;
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  std::size_t queue_most_bytes = 0;
};

/// One recording: takes events from any thread, writes them on a thread of its own. Each topic with events
/// gets a channel of its samples (`cdr`, schema `omgidl`); its disposes and unregistrations go to
/// `<topic>#lifecycle` (`json`). A Metadata record "swallowtail.recorder" holds the counters.
class Session {
 public:
  static Result<std::unique_ptr<Session>> start(const std::filesystem::path& path,
                                                std::vector<TopicQos> topics, const SessionParams& params);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const std::vector<TopicQos>& topics() const { return topics_; }
  /// Never waits. From any thread.
  void record(Event event);
  /// What DDS counts for a topic; totals, not increments. From any thread.
  void count_lost(std::size_t topic, std::uint64_t total);
  void count_incompatible(std::size_t topic, std::uint64_t total);
  std::uint64_t recorded() const { return recorded_.load(std::memory_order_relaxed); }
  /// Ok until the file cannot be written; then the reason.
  Status failure() const;
  /// Writes what is queued, the counters and the file's end. Once.
  Result<SessionSummary> finish();

 private:
  struct Topic;
  Session(mcap::Writer writer, std::vector<TopicQos> topics, const SessionParams& params);
  void run();
  Status write(const Event& event);
  Status write_lifecycle(const Event& event);
  Status open_channel(std::size_t index, Vendor vendor);
  Status open_lifecycle_channel(std::size_t index);
  Status write_counters();
  void fail(const Status& status);

  std::vector<TopicQos> topics_;
  SessionParams params_;
  mcap::Writer writer_;
  EventQueue queue_;
  std::vector<std::unique_ptr<Topic>> states_;
  std::optional<std::uint16_t> lifecycle_schema_;
  std::atomic<std::uint64_t> recorded_{0};
  mutable std::mutex failure_mutex_;
  Status failure_;
  std::thread thread_;
};

std::string_view name_of(Vendor vendor);

}  // namespace swallowtail::record
