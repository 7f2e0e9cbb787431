#include "coverage/gtsp/search/problem.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::gtsp::search {
namespace {

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
  if (instance.is_sparse() && size() > kMaxSparseMatrix) {
    list_arcs(instance, anchor);
    return;
  }
  if (is_plain && !instance.weights().empty()) {
    take_weights(instance);
  } else {
    own_weights_.assign(original_.size() * original_.size(), kNoWeight);
    if (is_plain && instance.is_complete() && are_distances_short(instance)) {
      fill_from_points(instance);
    } else {
      fill_from_arcs(instance, anchor);
    }
    weights_ = own_weights_;
    has_missing_ = lacks_arcs();
  }
  is_symmetric_ = looks_symmetric();
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
        own_weights_[at(u) * n + at(v)] = weight;
        own_weights_[at(v) * n + at(u)] = weight;
      }
    }
  });
  points_.clear();
}

/// The instance's own where they can be shared, else in this order.
void Problem::take_weights(const Instance& instance) {
  const std::size_t n = original_.size();
  weights_ = instance.weights();
  has_missing_ = instance.is_matrix_lacking();
  const bool is_whole = n == at(instance.vertex_count());
  if (is_whole && std::is_sorted(original_.begin(), original_.end())) return;
  own_weights_.reserve(n * n);
  for (const int u : original_) {
    const std::int32_t* const row = instance.weights().data() + at(u) * at(instance.vertex_count());
    for (const int v : original_) own_weights_.push_back(row[v]);
  }
  weights_ = own_weights_;
  if (!is_whole) has_missing_ = lacks_arcs();
}

/// What costs are multiplied by to be whole numbers of 30 bits.
double Problem::scale_of(const Instance& instance, const detail::Anchor& anchor) const {
  double largest = 0.0;
  bool is_whole = true;
  for (const int from : original_) {
    for_each_arc(instance, anchor, from, [&](int, double cost) {
      largest = std::max(largest, cost);
      is_whole = is_whole && cost == std::floor(cost);
    });
  }
  return (is_whole && largest <= kMaxWeight) || largest == 0.0 ? 1.0 : kMaxWeight / largest;
}

void Problem::fill_from_arcs(const Instance& instance, const detail::Anchor& anchor) {
  const double scale = scale_of(instance, anchor);
  for (int u = 0; u < size(); ++u) {
    std::int32_t* const row = own_weights_.data() + at(u) * original_.size();
    for_each_arc(instance, anchor, original(u), [&](int original_to, double cost) {
      const int v = numbered(original_to);
      if (v >= 0) row[v] = static_cast<std::int32_t>(std::lround(cost * scale));
    });
  }
}

void Problem::list_arcs(const Instance& instance, const detail::Anchor& anchor) {
  const double scale = scale_of(instance, anchor);
  arcs_out_ = ArcLists(size());
  std::vector<ListedArc> arcs;
  for (int u = 0; u < size(); ++u) {
    arcs.clear();
    for_each_arc(instance, anchor, original(u), [&](int original_to, double cost) {
      const int v = numbered(original_to);
      if (v >= 0) arcs.push_back({v, static_cast<std::int32_t>(std::lround(cost * scale))});
    });
    arcs_out_.append(u, arcs);
  }
  has_missing_ = true;
  arcs_into_ = arcs_out_.turned();
  for (int v = 0; v < size() && is_symmetric_; ++v) {
    is_symmetric_ = std::ranges::equal(arcs_out_.of(v), arcs_into_.of(v), [](ListedArc a, ListedArc b) {
      return a.vertex == b.vertex && a.weight == b.weight;
    });
  }
  if (is_symmetric_) arcs_into_ = {};
}

bool Problem::lacks_arcs() const {
  for (int u = 0; u < size(); ++u) {
    const auto row = weights_.subspan(at(u) * original_.size(), original_.size());
    const auto within = row.subspan(at(first(cluster_of(u))), at(cluster_size(cluster_of(u))));
    if (std::count(row.begin(), row.end(), kNoWeight) > std::count(within.begin(), within.end(), kNoWeight))
      return true;
  }
  return false;
}

bool Problem::looks_symmetric() const {
  const std::size_t n = original_.size();
  constexpr std::size_t kBlock = 32;
  for (std::size_t u0 = 0; u0 < n; u0 += kBlock) {
    for (std::size_t v0 = 0; v0 <= u0; v0 += kBlock) {
      for (std::size_t u = u0; u < std::min(n, u0 + kBlock); ++u) {
        for (std::size_t v = v0; v < std::min(n, v0 + kBlock); ++v) {
          if (weights_[u * n + v] != weights_[v * n + u] && cluster_of_[u] != cluster_of_[v]) return false;
        }
      }
    }
  }
  return true;
}

}  // namespace swallowtail::gtsp::search
