#include "coverage/gtsp/detail/least_arcs.hpp"

#include <algorithm>

namespace swallowtail::gtsp::detail {

LeastArcs::LeastArcs(const Instance& instance, const Anchor& anchor, const Pruning& pruning) {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  const int n = instance.vertex_count();
  std::vector<int> number_of(at(n) + 1, -1);  // of a vertex's cluster
  const auto append = [&](int v, int cluster) {
    if (cluster_.empty() || cluster_.back() != cluster) cluster_.push_back(cluster);
    number_of[at(v)] = cluster_count() - 1;
  };
  for (int c = 0; c < instance.cluster_count(); ++c) {
    for (const int v : instance.cluster(c)) {
      if (pruning.is_alive[at(v)] != 0) append(v, c);
    }
  }
  if (pruning.is_alive[at(n)] != 0) append(n, instance.cluster_count());
  least_.assign(cluster_.size() * cluster_.size(), kNoArc);
  for (int u = 0; u <= n; ++u) {
    if (number_of[at(u)] < 0) continue;
    double* const row = least_.data() + at(number_of[at(u)]) * cluster_.size();
    for_each_arc(instance, anchor, u, [&](int to, double cost) {
      if (number_of[at(to)] >= 0) row[number_of[at(to)]] = std::min(row[number_of[at(to)]], cost);
    });
  }
}

}  // namespace swallowtail::gtsp::detail
