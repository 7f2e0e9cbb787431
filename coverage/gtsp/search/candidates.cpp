#include "coverage/gtsp/search/candidates.hpp"

#include <algorithm>
#include <utility>

namespace swallowtail::gtsp::search {
namespace {

bool is_nearer(const Near& a, const Near& b) {
  return a.cost != b.cost ? a.cost < b.cost : a.vertex < b.vertex;
}

}  // namespace

Candidates::Candidates(const Problem& problem, const PointTree* tree, int most)
    : problem_(problem),
      tree_(tree),
      most_(static_cast<std::size_t>(std::min(most, problem.cluster_count() - 1))) {
  resize(out_);
  if (!problem.is_symmetric()) resize(into_);
}

void Candidates::resize(Lists& lists) const {
  lists.is_made.assign(static_cast<std::size_t>(problem_.size()), 0);
  lists.near.resize(static_cast<std::size_t>(problem_.size()) * most_);
}

void Candidates::make(Lists& lists, int v, Direction direction) {
  found_.clear();
  if (!problem_.arcs_out().empty()) {
    look_at_lists(v, direction);
  } else if (problem_.points().empty()) {
    look_at_matrix(v, direction);
  } else {
    look_at_points(v);
  }
  const auto end = found_.begin() + static_cast<std::ptrdiff_t>(most_);
  std::partial_sort(found_.begin(), end, found_.end(), is_nearer);
  std::copy(found_.begin(), end, lists.near.begin() + static_cast<std::ptrdiff_t>(most_) * v);
  lists.is_made[static_cast<std::size_t>(v)] = 1;
}

void Candidates::look_at_matrix(int v, Direction direction) {
  const MatrixCosts costs(problem_.weights().data(), problem_.size());
  for (int c = 0; c < problem_.cluster_count(); ++c) {
    if (c == problem_.cluster_of(v)) continue;
    Near best{problem_.first(c), kMissingArc};
    for (int w = problem_.first(c); w < problem_.last(c); ++w) {
      const Cost cost = direction == Direction::kInto ? costs(w, v) : costs(v, w);
      if (cost < best.cost) best = {w, cost};
    }
    found_.push_back(best);
  }
}

/// Filled up with clusters that no arc joins.
void Candidates::look_at_lists(int v, Direction direction) {
  const ArcLists& lists = direction == Direction::kInto ? problem_.arcs_into() : problem_.arcs_out();
  int cluster = -1;
  for (const ListedArc& arc : lists.of(v)) {
    if (problem_.cluster_of(arc.vertex) != std::exchange(cluster, problem_.cluster_of(arc.vertex)))
      found_.push_back({arc.vertex, arc.weight});
    else if (arc.weight < found_.back().cost)
      found_.back() = {arc.vertex, arc.weight};
  }
  for (int c = problem_.cluster_of(v); found_.size() < most_;) {
    c = c + 1 < problem_.cluster_count() ? c + 1 : 0;
    found_.push_back({problem_.first(c), kMissingArc});
  }
}

void Candidates::look_at_points(int v) {
  const std::vector<int>& nearest = tree_->nearest_of_clusters(v, most_, search_);
  problem_.with_costs([&](const auto& costs) {
    for (const int w : nearest) found_.push_back({w, costs(v, w)});
  });
}

}  // namespace swallowtail::gtsp::search
