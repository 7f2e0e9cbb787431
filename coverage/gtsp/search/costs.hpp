#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "coverage/gtsp/detail/metric.hpp"
#include "coverage/gtsp/search/arc_lists.hpp"

namespace swallowtail::gtsp::search {

/// Costs of tours while they are searched: integers, so that sums are exact and in any order the same.
using Cost = std::int64_t;

/// A missing arc counts as much as no sum of arcs does: tours compare by missing arcs first, then by cost.
inline constexpr Cost kMissingArc = Cost{1} << 44;

/// What a tour of that cost lacks, and what its other arcs cost.
inline int missing_in(Cost cost) { return static_cast<int>(cost / kMissingArc); }
inline Cost without_missing(Cost cost) { return cost % kMissingArc; }

/// Costs from a full matrix of 32-bit weights, row = from; kNoWeight = no arc.
class MatrixCosts {
 public:
  MatrixCosts(const std::int32_t* weights, int n) : weights_(weights), n_(static_cast<std::size_t>(n)) {}
  Cost operator()(int from, int to) const {
    const std::int32_t w = weights_[static_cast<std::size_t>(from) * n_ + static_cast<std::size_t>(to)];
    return w == kNoWeight ? kMissingArc : w;
  }

 private:
  const std::int32_t* weights_;
  std::size_t n_;
};

/// Costs looked up in the lists of the arcs that leave each vertex.
class ListCosts {
 public:
  explicit ListCosts(const ArcLists* lists) : lists_(lists) {}
  Cost operator()(int from, int to) const {
    const std::span<const ListedArc> arcs = lists_->of(from);
    const auto found = std::lower_bound(arcs.begin(), arcs.end(), to,
                                        [](const ListedArc& arc, int v) { return arc.vertex < v; });
    return found != arcs.end() && found->vertex == to ? found->weight : kMissingArc;
  }

 private:
  const ArcLists* lists_;
};

/// Costs computed from coordinates. The metric is a template argument so that none is chosen per arc.
template <Metric kMetric>
class PointCosts {
 public:
  explicit PointCosts(const Point* points) : points_(points) {}
  Cost operator()(int from, int to) const {
    if constexpr (kMetric == Metric::kEuc2D) {  // the same number without a call of floor
      const double dx = points_[from].x - points_[to].x;
      const double dy = points_[from].y - points_[to].y;
      return static_cast<Cost>(std::sqrt(dx * dx + dy * dy) + 0.5);
    }
    return static_cast<Cost>(detail::distance(points_[from], points_[to], kMetric));
  }

 private:
  const Point* points_;
};

}  // namespace swallowtail::gtsp::search
