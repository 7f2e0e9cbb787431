#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "qos/bus.hpp"
#include "qos/counters.hpp"
#include "qos/topics.hpp"

namespace swallowtail::memory {

/// What one reader is told: a sample, or that the instance `key` is gone.
template <class T>
struct Event {
  std::optional<T> sample;
  InstanceKey key{};
};

/// Runs one reader's handlers in order, one at a time, with no lock held.
template <class T>
class Subscription {
 public:
  Subscription(Handlers<T> handlers, std::shared_ptr<Counters> counters)
      : handlers_(std::move(handlers)), counters_(std::move(counters)) {}

  void enqueue(Event<T> event) {
    const std::lock_guard lock(mutex_);
    if (!closed_) queue_.push_back(std::move(event));
  }

  void drain() {
    std::unique_lock lock(mutex_);
    if (draining_) return;
    draining_ = true;
    while (!queue_.empty()) {
      const Event<T> event = std::move(queue_.front());
      queue_.pop_front();
      lock.unlock();
      run(event);
      lock.lock();
    }
    draining_ = false;
    idle_.notify_all();
  }

  /// No handler runs after this; never to be called from one.
  void close() {
    std::unique_lock lock(mutex_);
    closed_ = true;
    queue_.clear();
    idle_.wait(lock, [this] { return !draining_; });
  }

 private:
  void run(const Event<T>& event) {
    if (event.sample) {
      counters_->accept();
      if (handlers_.on_sample) handlers_.on_sample(*event.sample);
    } else if (handlers_.on_gone) {
      handlers_.on_gone(event.key);
    }
  }

  const Handlers<T> handlers_;
  const std::shared_ptr<Counters> counters_;
  std::mutex mutex_;
  std::condition_variable idle_;
  std::deque<Event<T>> queue_;
  bool draining_ = false;
  bool closed_ = false;
};

/// One topic of the network: who writes which instance with which last sample, and who reads.
template <class T>
class Topic {
 public:
  using Reader = std::shared_ptr<Subscription<T>>;
  static constexpr const TopicQos& kQos = TopicOf<T>::qos;

  int add_writer(std::int32_t strength) {
    const std::lock_guard lock(mutex_);
    writers_[++last_writer_].strength = strength;
    return last_writer_;
  }

  void remove_writer(int id) {
    const std::vector<Reader> readers = [&] {
      const std::lock_guard lock(mutex_);
      const std::map<InstanceKey, T> written = std::move(writers_.at(id).last);
      writers_.erase(id);
      for (const auto& [key, sample] : written) {
        if (!owner(key)) tell({std::nullopt, key});
      }
      return readers_;
    }();
    for (const Reader& reader : readers) reader->drain();
  }

  void publish(int id, const T& sample) {
    const InstanceKey key = TopicOf<T>::key(sample);
    const std::vector<Reader> readers = [&] {
      const std::lock_guard lock(mutex_);
      writers_.at(id).last.insert_or_assign(key, sample);
      if (may_write(id, key)) tell({sample, key});
      return readers_;
    }();
    for (const Reader& reader : readers) reader->drain();
  }

  void dispose(int id, const T& last) {
    const InstanceKey key = TopicOf<T>::key(last);
    const std::vector<Reader> readers = [&] {
      const std::lock_guard lock(mutex_);
      const bool counts = may_write(id, key);
      writers_.at(id).last.erase(key);
      if (counts) tell({std::nullopt, key});
      return readers_;
    }();
    for (const Reader& reader : readers) reader->drain();
  }

  void add_reader(const Reader& reader) {
    {
      const std::lock_guard lock(mutex_);
      readers_.push_back(reader);
      if (kQos.durability == Durability::kTransientLocal) {
        for (const auto& [id, writer] : writers_) {
          for (const auto& [key, sample] : writer.last) {
            if (may_write(id, key)) reader->enqueue({sample, key});
          }
        }
      }
    }
    reader->drain();
  }

  void remove_reader(const Reader& reader) {
    const std::lock_guard lock(mutex_);
    std::erase(readers_, reader);
  }

 private:
  struct Writer {
    std::int32_t strength = 0;
    std::map<InstanceKey, T> last{};
  };

  /// The strongest writer of the instance, the oldest among equals.
  std::optional<int> owner(const InstanceKey& key) const {
    std::optional<int> best;
    for (const auto& [id, writer] : writers_) {
      if (!writer.last.contains(key)) continue;
      if (!best || writer.strength > writers_.at(*best).strength) best = id;
    }
    return best;
  }

  bool may_write(int id, const InstanceKey& key) const {
    if (kQos.ownership == Ownership::kShared) return true;
    const std::optional<int> strongest = owner(key);
    return !strongest || *strongest == id;
  }

  void tell(const Event<T>& event) {
    for (const Reader& reader : readers_) reader->enqueue(event);
  }

  std::mutex mutex_;
  int last_writer_ = 0;
  std::map<int, Writer> writers_;
  std::vector<Reader> readers_;
};

}  // namespace swallowtail::memory
