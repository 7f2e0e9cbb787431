#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <vector>

#include "qos/bus.hpp"

namespace swallowtail {

/// The counts behind BusStatistics; safe to call from any thread. Counting allocates only when a (topic,
/// reason) pair is new, and at most data::kMaxRejections pairs are told apart: what comes after them is
/// counted as ("*", "other").
class Counters {
 public:
  Counters();

  void accept() { accepted_.fetch_add(1, std::memory_order_relaxed); }
  void miss_deadlines(std::uint64_t count) { missed_deadlines_.fetch_add(count, std::memory_order_relaxed); }
  void meet_incompatible(std::uint64_t count) {
    incompatible_qos_.fetch_add(count, std::memory_order_relaxed);
  }
  /// `topic` and `reason` must live as long as the program does (literals, the table's names).
  void reject(std::string_view topic, std::string_view reason, std::uint64_t count = 1);

  BusStatistics snapshot() const;

 private:
  struct Row {
    std::string_view topic;
    std::string_view reason;
    std::uint64_t count;
  };

  std::atomic<std::uint64_t> accepted_{0};
  std::atomic<std::uint64_t> missed_deadlines_{0};
  std::atomic<std::uint64_t> incompatible_qos_{0};
  mutable std::mutex mutex_;
  std::vector<Row> rows_;
};

}  // namespace swallowtail
