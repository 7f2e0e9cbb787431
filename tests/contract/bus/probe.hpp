#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

#include "qos/bus.hpp"
#include "qos/topics.hpp"

namespace swallowtail::testing {

inline constexpr std::chrono::seconds kPatience{
    8};  // bounds every wait; Cyclone joining Fast takes up to about 1.1 s

/// Keeps what a subscription is told, for tests that wait for it.
template <class T>
class Probe {
 public:
  Handlers<T> handlers() {
    return {.on_sample =
                [this](const T& sample) {
                  const std::lock_guard lock(mutex_);
                  samples_.push_back(sample);
                  times_.push_back(std::chrono::steady_clock::now());
                  changed_.notify_all();
                },
            .on_gone =
                [this](const InstanceKey& key) {
                  const std::lock_guard lock(mutex_);
                  gone_.push_back(key);
                  changed_.notify_all();
                }};
  }

  /// Waits until `is_there(samples, gone keys)` holds; false when it does not within the time.
  template <class Condition>
  bool wait(Condition is_there, std::chrono::milliseconds limit = kPatience) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, limit, [&] { return is_there(samples_, gone_); });
  }
  bool wait_for_samples(std::size_t count, std::chrono::milliseconds limit = kPatience) {
    return wait([count](const auto& samples, const auto&) { return samples.size() >= count; }, limit);
  }
  bool wait_for_gone(const InstanceKey& key, std::chrono::milliseconds limit = kPatience) {
    return wait(
        [&key](const auto&, const auto& gone) {
          for (const InstanceKey& k : gone) {
            if (k == key) return true;
          }
          return false;
        },
        limit);
  }

  std::vector<T> samples() const {
    const std::lock_guard lock(mutex_);
    return samples_;
  }
  std::vector<InstanceKey> gone() const {
    const std::lock_guard lock(mutex_);
    return gone_;
  }
  /// When each sample came.
  std::vector<std::chrono::steady_clock::time_point> times() const {
    const std::lock_guard lock(mutex_);
    return times_;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    samples_.clear();
    times_.clear();
    gone_.clear();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> samples_;
  std::vector<std::chrono::steady_clock::time_point> times_;
  std::vector<InstanceKey> gone_;
};

}  // namespace swallowtail::testing
