#include "coverage/gtsp/detail/reduced.hpp"

#include <algorithm>
#include <limits>

namespace swallowtail::gtsp::detail {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

}  // namespace

Reduced::Reduced(const Instance& instance, const Anchor& anchor, const Pruning& pruning) {
  number_vertices(instance, pruning);
  fill(instance, anchor);
  find_symmetry();
  find_least();
  find_neighbours();
}

void Reduced::number_vertices(const Instance& instance, const Pruning& pruning) {
  const int n = instance.vertex_count();
  reduced_.assign(at(n) + 1, -1);
  const auto append = [&](int v, int c) {
    reduced_[at(v)] = size();
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

void Reduced::fill(const Instance& instance, const Anchor& anchor) {
  const std::size_t n = original_.size();
  const std::size_t m = first_.size() - 1;
  out_.assign(n * n, kNone);
  least_arc_.assign(m * m, kNoArc);
  for (int u = 0; u < size(); ++u) {
    float* const row = out_.data() + at(u) * n;
    double* const least_row = least_arc_.data() + at(cluster_of(u)) * m;
    for_each_arc(instance, anchor, original(u), [&](int original_to, double cost) {
      const int v = reduced(original_to);
      if (v < 0) return;
      row[v] = static_cast<float>(cost);
      double& least = least_row[cluster_of(v)];
      least = std::min(least, cost);
    });
  }
}

void Reduced::find_symmetry() {
  const std::size_t n = original_.size();
  is_symmetric_ = true;
  for (std::size_t u = 0; u < n && is_symmetric_; ++u) {
    for (std::size_t v = 0; v < u && is_symmetric_; ++v) is_symmetric_ = out_[u * n + v] == out_[v * n + u];
  }
  if (is_symmetric_) return;
  in_.resize(n * n);
  constexpr std::size_t kBlock = 32;
  for (std::size_t u0 = 0; u0 < n; u0 += kBlock) {
    for (std::size_t v0 = 0; v0 < n; v0 += kBlock) {
      for (std::size_t u = u0; u < std::min(n, u0 + kBlock); ++u) {
        for (std::size_t v = v0; v < std::min(n, v0 + kBlock); ++v) in_[v * n + u] = out_[u * n + v];
      }
    }
  }
}

void Reduced::find_least() {
  const std::size_t n = original_.size();
  const auto fill_least = [&](std::vector<float>& least, const std::vector<float>& matrix) {
    least.assign(n * (first_.size() - 1), kNone);
    for (std::size_t u = 0; u < n; ++u) {
      const float* const row = matrix.data() + u * n;
      for (std::size_t c = 0; c + 1 < first_.size(); ++c)
        least[c * n + u] = *std::min_element(row + first_[c], row + first_[c + 1]);
    }
  };
  fill_least(least_out_, out_);
  if (!is_symmetric_) fill_least(least_in_, in_);
}

void Reduced::find_neighbours() {
  const int m = cluster_count();
  neighbours_.resize(at(m));
  std::vector<std::pair<double, int>> others;
  for (int a = 0; a < m; ++a) {
    others.clear();
    for (int b = 0; b < m; ++b) {
      if (b != a) others.emplace_back(std::min(least_arc(a, b), least_arc(b, a)), b);
    }
    const std::size_t kept = std::min<std::size_t>(others.size(), kNeighbours);
    std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(kept), others.end());
    for (std::size_t i = 0; i < kept; ++i) neighbours_[at(a)].push_back(others[i].second);
  }
}

}  // namespace swallowtail::gtsp::detail
