#include "coverage/gtsp/search/problem.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::gtsp::search {
namespace {

constexpr double kMaxWeight = 1 << 30;

}  // namespace

Problem::Problem(const Instance& instance, const detail::Anchor& anchor, const detail::Pruning& pruning) {
  number_vertices(instance, pruning);
  const bool is_computed = instance.is_complete() && anchor_ < 0 && size() > kMaxPointMatrix;
  if (!is_computed) {
    fill_matrix(instance, anchor);
    return;
  }
  metric_ = instance.metric();
  for (const int v : original_) points_.push_back(instance.points()[at(v)]);
}

void Problem::number_vertices(const Instance& instance, const detail::Pruning& pruning) {
  const int n = instance.vertex_count();
  numbered_.assign(at(n) + 1, -1);
  const auto append = [&](int v, int c) {
    numbered_[at(v)] = size();
    original_.push_back(v);
    cluster_of_.push_back(c);
  };
  first_ = {0};
  for (int c = 0; c < instance.cluster_count(); ++c) {
    for (const int v : instance.cluster(c)) {
      if (pruning.is_alive[at(v)] != 0) append(v, cluster_count());
    }
    if (size() > first_.back()) first_.push_back(size());
  }
  if (pruning.is_alive[at(n)] == 0) return;
  anchor_ = size();
  append(n, cluster_count());
  first_.push_back(size());
}

void Problem::fill_matrix(const Instance& instance, const detail::Anchor& anchor) {
  const std::size_t n = original_.size();
  double largest = 0.0;
  bool is_whole = true;
  for (const int from : original_) {
    for_each_arc(instance, anchor, from, [&](int, double cost) {
      largest = std::max(largest, cost);
      is_whole = is_whole && cost == std::floor(cost);
    });
  }
  const double scale = (is_whole && largest <= kMaxWeight) || largest == 0.0 ? 1.0 : kMaxWeight / largest;
  weights_.assign(n * n, kNoWeight);
  std::size_t arcs = 0;
  for (int u = 0; u < size(); ++u) {
    std::int32_t* const row = weights_.data() + at(u) * n;
    for_each_arc(instance, anchor, original(u), [&](int original_to, double cost) {
      const int v = numbered(original_to);
      if (v < 0 || cluster_of(u) == cluster_of(v)) return;
      row[v] = static_cast<std::int32_t>(std::lround(cost * scale));
      ++arcs;
    });
  }
  std::size_t most = n * n;
  for (int c = 0; c < cluster_count(); ++c) most -= at(cluster_size(c)) * at(cluster_size(c));
  has_missing_ = arcs < most;
  for (std::size_t u = 0; u < n && is_symmetric_; ++u) {
    for (std::size_t v = 0; v < u && is_symmetric_; ++v)
      is_symmetric_ = weights_[u * n + v] == weights_[v * n + u];
  }
}

}  // namespace swallowtail::gtsp::search
