#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

#include "coverage/gtsp/proof/subset_kernel.hpp"
#include "planner/base/stop.hpp"

namespace swallowtail::gtsp::proof {

/// Set of clusters other than the one that tours begin in.
using SubsetMask = std::uint32_t;

/// Costs are 32-bit integers or doubles.
template <class Cost>
inline constexpr Cost kNoWay = [] {
  if constexpr (std::is_same_v<Cost, std::int32_t>) {
    return kNoWay32;
  } else {
    return std::numeric_limits<Cost>::infinity();
  }
}();

/// The clusters' vertices in slots: each cluster's side by side, filled up to whole lanes with slots of no
/// vertex.
struct SubsetSlots {
  std::vector<int> cluster;  ///< by bit of a mask
  std::vector<int> first;    ///< by bit, and one past the last
  std::vector<int> vertex;   ///< by slot, −1 = none

  int bits() const { return static_cast<int>(cluster.size()); }
  int count() const { return first.back(); }
  int width(int bit) const {
    return first[static_cast<std::size_t>(bit) + 1] - first[static_cast<std::size_t>(bit)];
  }
};

/// Least costs of ways by (set of clusters visited, last vertex) [HELD-KARP].
template <class Cost>
class SubsetTable {
 public:
  /// Arcs onwards: steps[first[bit]·count + u·width(bit) + lane] from slot u to the cluster's lane-th vertex.
  /// `start` is the cost by slot of ways of one vertex; `needs`, by bit, what a set must hold before the
  /// cluster joins it.
  struct Ways {
    std::vector<Cost> steps;
    std::vector<Cost> start;
    std::vector<SubsetMask> needs;
  };

  explicit SubsetTable(const SubsetSlots& slots);

  /// What ends a way: ways that `back` cannot complete to one that costs less than `limit` are not gone on
  /// with.
  struct Completion {
    const SubsetTable& back;
    Cost limit;
  };
  enum class End { kFilled, kStopped, kTooMuchWork };
  /// At most `max_work` elementary steps (additions) more. With a completion, marks the slots in use.
  End fill(const Ways& ways, const Completion* completion, double max_work, const StopCondition& stop);

  /// kNoWay when there is none.
  Cost least(SubsetMask set, int slot) const;
  SubsetMask all() const { return (SubsetMask{1} << slots_.bits()) - 1; }
  double work() const { return work_; }
  const std::vector<char>& is_used() const { return is_used_; }  ///< by slot
  /// Slots of the least way that ends at `slot` after all of `set`, last first.
  std::vector<int> way_back(const Ways& ways, SubsetMask set, int slot) const;

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  bool holds(SubsetMask set, int bit) const { return (rows_[set] >> bit & 1) != 0; }
  Cost* row(SubsetMask set, int bit) { return values_.get() + set * at(slots_.count()) + at(first(bit)); }
  const Cost* row(SubsetMask set, int bit) const {
    return values_.get() + set * at(slots_.count()) + at(first(bit));
  }
  int first(int bit) const { return slots_.first[at(bit)]; }
  void start(const Ways& ways);
  void list(SubsetMask set, const Completion* completion);
  void go_on(SubsetMask set, const Ways& ways);

  const SubsetSlots& slots_;
  std::unique_ptr<Cost[]> values_;  ///< by set and slot; only rows that rows_ names
  std::vector<SubsetMask> rows_;    ///< by set: last clusters that there are values for
  std::vector<int> from_;           ///< slots with a way for the set at hand
  std::vector<Cost> value_;         ///< theirs
  std::vector<char> is_used_;
  double work_ = 0.0;
};

extern template class SubsetTable<std::int32_t>;
extern template class SubsetTable<double>;

}  // namespace swallowtail::gtsp::proof
