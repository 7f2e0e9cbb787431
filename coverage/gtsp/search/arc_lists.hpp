#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swallowtail::gtsp::search {

struct ListedArc {
  int vertex = 0;  ///< at its other end
  std::int32_t weight = 0;
};

/// The arcs that leave each vertex, or those that lead to each, by ascending other end.
class ArcLists {
 public:
  ArcLists() = default;
  explicit ArcLists(int vertex_count) : first_(static_cast<std::size_t>(vertex_count) + 1, 0) {}

  bool empty() const { return arcs_.empty(); }
  std::span<const ListedArc> of(int v) const {
    const auto i = static_cast<std::size_t>(v);
    return std::span(arcs_).subspan(first_[i], first_[i + 1] - first_[i]);
  }

  /// Appends the arcs of the next vertex, v, sorting them.
  void append(int v, std::span<ListedArc> arcs) {
    std::sort(arcs.begin(), arcs.end(),
              [](const ListedArc& a, const ListedArc& b) { return a.vertex < b.vertex; });
    arcs_.insert(arcs_.end(), arcs.begin(), arcs.end());
    first_[static_cast<std::size_t>(v) + 1] = arcs_.size();
  }

  /// The same arcs listed at their other ends.
  ArcLists turned() const {
    ArcLists other(static_cast<int>(first_.size()) - 1);
    for (const ListedArc& arc : arcs_) ++other.first_[static_cast<std::size_t>(arc.vertex) + 1];
    for (std::size_t v = 1; v < other.first_.size(); ++v) other.first_[v] += other.first_[v - 1];
    other.arcs_.resize(arcs_.size());
    std::vector<std::size_t> next(other.first_.begin(), other.first_.end() - 1);
    for (std::size_t u = 0; u + 1 < first_.size(); ++u) {
      for (std::size_t i = first_[u]; i < first_[u + 1]; ++i)
        other.arcs_[next[static_cast<std::size_t>(arcs_[i].vertex)]++] = {static_cast<int>(u),
                                                                          arcs_[i].weight};
    }
    return other;
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<ListedArc> arcs_;
};

}  // namespace swallowtail::gtsp::search
