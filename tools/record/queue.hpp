#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "tools/record/event.hpp"

namespace swallowtail::record {

/// Between the receiving threads and the one that writes: bounded in payload bytes and in events. A full
/// queue refuses; it never makes a receiving thread wait, since that would hold up the writers on the wire.
class EventQueue {
 public:
  EventQueue(std::size_t max_bytes, std::size_t max_events)
      : max_bytes_(max_bytes), max_events_(max_events) {}

  /// Whether the event was taken; it is gone either way.
  [[nodiscard]] bool push(Event event) {
    {
      const std::lock_guard lock(mutex_);
      const std::size_t size = event.payload.bytes().size();
      if (closed_ || events_.size() >= max_events_ || (!events_.empty() && bytes_ + size > max_bytes_))
        return false;
      bytes_ += size;
      most_bytes_ = bytes_ > most_bytes_ ? bytes_ : most_bytes_;
      events_.push_back(std::move(event));
      if (events_.size() > 1) return true;
    }
    filled_.notify_one();
    return true;
  }

  /// Moves everything that is there into `into` (emptied first), waiting for something up to `timeout`.
  /// False once the queue is closed and empty.
  bool take_all(std::vector<Event>& into, std::chrono::nanoseconds timeout) {
    into.clear();
    std::unique_lock lock(mutex_);
    filled_.wait_for(lock, timeout, [this] { return closed_ || !events_.empty(); });
    std::swap(into, events_);
    bytes_ = 0;
    return !(closed_ && into.empty());
  }

  /// No more events are taken; those that are there still come out.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    filled_.notify_all();
  }

  /// The most payload bytes that ever waited.
  std::size_t most_bytes() const {
    const std::lock_guard lock(mutex_);
    return most_bytes_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable filled_;
  std::vector<Event> events_;
  std::size_t bytes_ = 0;
  std::size_t most_bytes_ = 0;
  std::size_t max_bytes_;
  std::size_t max_events_;
  bool closed_ = false;
};

}  // namespace swallowtail::record
