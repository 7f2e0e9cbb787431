#pragma once

#include <cstddef>
#include <vector>

namespace swallowtail::gtsp::search {

/// Clusters waiting for another look, each at most once.
class WorkQueue {
 public:
  explicit WorkQueue(int clusters) : is_in_(static_cast<std::size_t>(clusters), 0) {}
  void push(int c) {
    if (is_in_[static_cast<std::size_t>(c)] != 0) return;
    is_in_[static_cast<std::size_t>(c)] = 1;
    waiting_.push_back(c);
  }
  int pop() {
    const int c = waiting_[head_++];
    is_in_[static_cast<std::size_t>(c)] = 0;
    if (head_ == waiting_.size()) {
      waiting_.clear();
      head_ = 0;
    }
    return c;
  }
  bool empty() const { return waiting_.empty(); }

 private:
  std::vector<char> is_in_;
  std::vector<int> waiting_;
  std::size_t head_ = 0;
};

}  // namespace swallowtail::gtsp::search
