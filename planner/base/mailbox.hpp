#pragma once

#include <mutex>
#include <optional>
#include <utility>

namespace swallowtail {

/// Hands the newest value from a listener to a worker: a newer value replaces one not yet taken. The lock is
/// held for a move only.
template <class T>
class Mailbox {
 public:
  void put(T value) {
    const std::lock_guard lock(mutex_);
    value_ = std::move(value);
  }

  std::optional<T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(value_, std::nullopt);
  }

 private:
  std::mutex mutex_;
  std::optional<T> value_;
};

}  // namespace swallowtail
