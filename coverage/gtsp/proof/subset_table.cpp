#include "coverage/gtsp/proof/subset_table.hpp"

#include <algorithm>
#include <bit>

namespace swallowtail::gtsp::proof {
namespace {

constexpr SubsetMask kSetsBetweenStops = 256;

}  // namespace

template <class Cost>
SubsetTable<Cost>::SubsetTable(const SubsetSlots& slots)
    : slots_(slots),
      values_(std::make_unique_for_overwrite<Cost[]>(at(slots.count()) << slots.bits())),
      rows_(std::size_t{1} << slots.bits(), 0),
      from_(at(slots.count())),
      value_(at(slots.count())),
      is_used_(at(slots.count()), 0) {}

template <class Cost>
void SubsetTable<Cost>::start(const Ways& ways) {
  std::fill(rows_.begin(), rows_.end(), 0);
  for (int bit = 0; bit < slots_.bits(); ++bit) {
    if (ways.needs[at(bit)] != 0) continue;
    const SubsetMask set = SubsetMask{1} << bit;
    std::copy_n(ways.start.data() + first(bit), slots_.width(bit), row(set, bit));
    rows_[set] = set;
  }
}

/// The vertices that ways over the set end at, as far as they are worth going on with.
template <class Cost>
void SubsetTable<Cost>::list(SubsetMask set, const Completion* completion) {
  from_.clear();
  value_.clear();
  for (SubsetMask rest = rows_[set]; rest != 0; rest &= rest - 1) {
    const int bit = std::countr_zero(rest);
    const SubsetMask ahead = (all() & ~set) | SubsetMask{1} << bit;
    if (completion != nullptr && !completion->back.holds(ahead, bit)) continue;
    const Cost* const value = row(set, bit);
    const Cost* const onwards = completion != nullptr ? completion->back.row(ahead, bit) : nullptr;
    for (int lane = 0; lane < slots_.width(bit); ++lane) {
      if (onwards != nullptr ? value[lane] + onwards[lane] >= completion->limit : value[lane] >= kNoWay<Cost>)
        continue;
      from_.push_back(first(bit) + lane);
      value_.push_back(value[lane]);
    }
  }
}

template <class Cost>
void SubsetTable<Cost>::go_on(SubsetMask set, const Ways& ways) {
  for (SubsetMask rest = all() & ~set; rest != 0; rest &= rest - 1) {
    const int bit = std::countr_zero(rest);
    if ((ways.needs[at(bit)] & ~set) != 0) continue;
    const SubsetMask next = set | SubsetMask{1} << bit;
    const Cost* const steps = ways.steps.data() + at(first(bit)) * at(slots_.count());
    least_ways_on(value_.data(), from_.data(), static_cast<int>(from_.size()), steps, slots_.width(bit),
                  row(next, bit));
    rows_[next] |= SubsetMask{1} << bit;
    work_ += static_cast<double>(from_.size()) * slots_.width(bit);
  }
}

template <class Cost>
auto SubsetTable<Cost>::fill(const Ways& ways, const Completion* completion, double max_work,
                             const StopCondition& stop) -> End {
  start(ways);
  const double most = work_ + max_work;
  for (SubsetMask set = 1; set <= all(); ++set) {
    if (set % kSetsBetweenStops == 0 && stop.reached(0, 0)) return End::kStopped;
    if (work_ > most) return End::kTooMuchWork;
    if (rows_[set] == 0) continue;
    list(set, completion);
    if (from_.empty()) continue;
    if (completion != nullptr) {
      for (const int slot : from_) is_used_[at(slot)] = 1;
    }
    go_on(set, ways);
  }
  return End::kFilled;
}

template <class Cost>
Cost SubsetTable<Cost>::least(SubsetMask set, int slot) const {
  const auto after = std::upper_bound(slots_.first.begin(), slots_.first.end(), slot);
  const int bit = static_cast<int>(after - slots_.first.begin()) - 1;
  return holds(set, bit) ? row(set, bit)[slot - first(bit)] : kNoWay<Cost>;
}

template <class Cost>
std::vector<int> SubsetTable<Cost>::way_back(const Ways& ways, SubsetMask set, int slot) const {
  std::vector<int> way;
  for (;;) {
    way.push_back(slot);
    const auto after = std::upper_bound(slots_.first.begin(), slots_.first.end(), slot);
    const int bit = static_cast<int>(after - slots_.first.begin()) - 1;
    const SubsetMask before = set & ~(SubsetMask{1} << bit);
    if (before == 0) return way;
    const Cost* const steps = ways.steps.data() + at(first(bit)) * at(slots_.count());
    const Cost value = least(set, slot);
    int from = 0;
    while (least(before, from) >= kNoWay<Cost> ||
           least(before, from) + steps[at(from) * at(slots_.width(bit)) + at(slot - first(bit))] != value)
      ++from;
    set = before;
    slot = from;
  }
}

template class SubsetTable<std::int32_t>;
template class SubsetTable<double>;

}  // namespace swallowtail::gtsp::proof
