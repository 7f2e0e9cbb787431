#include "coverage/gtsp/search/problem.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::gtsp::search {
namespace {

constexpr double kMaxWeight = 1 << 30;

/// Whether all distances fit into 30 bits.
bool are_distances_short(const Instance& instance) {
  if (instance.metric() == Metric::kGeo || instance.metric() == Metric::kGeom) return true;
  double largest = 0.0;
  for (const Point& p : instance.points()) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return largest < kMaxWeight / 4.0;
}

}  // namespace

Problem::Problem(const Instance& instance, const detail::Anchor& anchor, const detail::Pruning& pruning) {
  number_vertices(instance, pruning);
  const bool is_plain = anchor_ < 0;
  metric_ = instance.metric();
  if (is_plain && instance.is_complete() && size() > kMaxPointMatrix) {
    for (const int v : original_) points_.push_back(instance.points()[at(v)]);
    return;
  }
  weights_.assign(original_.size() * original_.size(), kNoWeight);
  if (is_plain && instance.is_complete() && are_distances_short(instance)) {
    fill_from_points(instance);
  } else if (!is_plain || instance.matrix().empty() || !fill_from_matrix(instance)) {
    fill_from_arcs(instance, anchor);
  }
  finish_matrix();
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

void Problem::fill_from_points(const Instance& instance) {
  const std::size_t n = original_.size();
  for (const int v : original_) points_.push_back(instance.points()[at(v)]);
  with_costs([&](const auto& costs) {
    for (int u = 0; u < size(); ++u) {
      for (int v = 0; v < u; ++v) {
        const auto weight = static_cast<std::int32_t>(costs(u, v));
        weights_[at(u) * n + at(v)] = weight;
        weights_[at(v) * n + at(u)] = weight;
      }
    }
  });
  points_.clear();
}

bool Problem::fill_from_matrix(const Instance& instance) {
  const std::size_t n = original_.size();
  bool is_whole = true;
  for (std::size_t u = 0; u < n && is_whole; ++u) {
    const double* const from = instance.matrix().data() + at(original_[u]) * at(instance.vertex_count());
    std::int32_t* const row = weights_.data() + u * n;
    for (std::size_t v = 0; v < n; ++v) {
      const double cost = from[original_[v]];
      if (cost == kNoArc) continue;
      row[v] = cost <= kMaxWeight ? static_cast<std::int32_t>(cost) : 0;
      is_whole = is_whole && row[v] == cost;
    }
  }
  return is_whole;
}

void Problem::fill_from_arcs(const Instance& instance, const detail::Anchor& anchor) {
  double largest = 0.0;
  bool is_whole = true;
  for (const int from : original_) {
    for_each_arc(instance, anchor, from, [&](int, double cost) {
      largest = std::max(largest, cost);
      is_whole = is_whole && cost == std::floor(cost);
    });
  }
  const double scale = (is_whole && largest <= kMaxWeight) || largest == 0.0 ? 1.0 : kMaxWeight / largest;
  std::fill(weights_.begin(), weights_.end(), kNoWeight);
  for (int u = 0; u < size(); ++u) {
    std::int32_t* const row = weights_.data() + at(u) * original_.size();
    for_each_arc(instance, anchor, original(u), [&](int original_to, double cost) {
      const int v = numbered(original_to);
      if (v >= 0) row[v] = static_cast<std::int32_t>(std::lround(cost * scale));
    });
  }
}

/// No arcs within clusters; then what is missing, and symmetry.
void Problem::finish_matrix() {
  const std::size_t n = original_.size();
  std::ptrdiff_t within = 0;
  for (int c = 0; c < cluster_count(); ++c) {
    within += std::ptrdiff_t{cluster_size(c)} * cluster_size(c);
    for (int u = first(c); u < last(c); ++u) {
      std::int32_t* const row = weights_.data() + at(u) * n;
      std::fill(row + first(c), row + last(c), kNoWeight);
    }
  }
  has_missing_ = std::count(weights_.begin(), weights_.end(), kNoWeight) > within;
  constexpr std::size_t kBlock = 32;
  for (std::size_t u0 = 0; u0 < n && is_symmetric_; u0 += kBlock) {
    for (std::size_t v0 = 0; v0 <= u0 && is_symmetric_; v0 += kBlock) {
      for (std::size_t u = u0; u < std::min(n, u0 + kBlock); ++u) {
        for (std::size_t v = v0; v < std::min(n, v0 + kBlock); ++v)
          is_symmetric_ = is_symmetric_ && weights_[u * n + v] == weights_[v * n + u];
      }
    }
  }
}

}  // namespace swallowtail::gtsp::search
