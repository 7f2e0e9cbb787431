#include "qos/counters.hpp"

#include <algorithm>

namespace swallowtail {

Counters::Counters() { rows_.reserve(data::kMaxRejections); }

void Counters::reject(std::string_view topic, std::string_view reason, std::uint64_t count) {
  const std::lock_guard lock(mutex_);
  const auto is_row = [](std::string_view t, std::string_view r) {
    return [t, r](const Row& row) { return row.topic == t && row.reason == r; };
  };
  auto row = std::find_if(rows_.begin(), rows_.end(), is_row(topic, reason));
  if (row == rows_.end() && rows_.size() + 1 >= data::kMaxRejections) {
    topic = "*";
    reason = "other";
    row = std::find_if(rows_.begin(), rows_.end(), is_row(topic, reason));
  }
  if (row != rows_.end()) {
    row->count += count;
  } else {
    rows_.push_back({topic, reason, count});
  }
}

BusStatistics Counters::snapshot() const {
  BusStatistics statistics;
  statistics.accepted = accepted_.load(std::memory_order_relaxed);
  statistics.missed_deadlines = missed_deadlines_.load(std::memory_order_relaxed);
  statistics.incompatible_qos = incompatible_qos_.load(std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  for (const Row& row : rows_) {
    statistics.rejected.push_back({std::string(row.topic), std::string(row.reason), row.count});
  }
  return statistics;
}

}  // namespace swallowtail
