#pragma once

#include <functional>
#include <mutex>
#include <vector>

#include "coverage/gtsp/detail/anchor.hpp"

namespace swallowtail::gtsp::detail {

/// A tour of the instance with its exact cost; empty = none.
struct Found {
  std::vector<int> tour;
  double cost = kNoArc;
};

/// The instance's tour that a closed tour of the folded one stands for, its cost summed over the instance;
/// kNoArc if arcs are missing. original(v): the instance's vertex of one of `order`, its vertex count for the
/// anchor.
Found found_from(const Instance& instance, const Anchor& anchor, const std::vector<int>& order,
                 const std::function<int(int)>& original, TourKind kind);

/// The best over all threads as the run goes on: the history and the caller's callback.
class Incumbents {
 public:
  explicit Incumbents(const Options& options);
  void offer(const Found& found, std::uint64_t iteration);
  std::vector<HistoryEntry> history() const;
  double now_s() const;  ///< since construction; 0 without a clock

 private:
  const Options& options_;
  double begin_s_;
  mutable std::mutex mutex_;
  double best_ = kNoArc;
  std::vector<HistoryEntry> history_;
};

}  // namespace swallowtail::gtsp::detail
