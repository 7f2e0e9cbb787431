#include "coverage/gtsp/detail/exact.hpp"

#include <algorithm>

#include "coverage/gtsp/proof/subset_search.hpp"

namespace swallowtail::gtsp::detail {
namespace {

using Kind = proof::SubsetAnswer::Kind;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The folded instance's clusters, the anchor's first if there is one, their living vertices numbered in
/// order.
class FoldedProblem {
 public:
  FoldedProblem(const Instance& instance, const Anchor& anchor, const Pruning& pruning) {
    const int n = instance.vertex_count();
    number_.assign(at(n) + 1, -1);
    if (anchor.is_used) append({n}, -1);
    for (int c = 0; c < instance.cluster_count(); ++c) {
      std::vector<int> living;
      for (const int v : instance.cluster(c)) {
        if (pruning.is_alive[at(v)] != 0) living.push_back(v);
      }
      if (!living.empty()) append(living, c);
    }
    if (anchor.is_used) problem_.root = 0;
    load_costs(instance, anchor);
  }

  void load_precedence(std::span<const std::pair<int, int>> pairs) {
    if (pairs.empty()) return;
    problem_.before.resize(problem_.clusters.size());
    for (const auto& [first, second] : pairs) {
      const auto earlier = std::find(cluster_.begin(), cluster_.end(), first);
      const auto later = std::find(cluster_.begin(), cluster_.end(), second);
      if (earlier == cluster_.end() || later == cluster_.end()) continue;
      problem_.before[at(static_cast<int>(later - cluster_.begin()))].push_back(
          static_cast<int>(earlier - cluster_.begin()));
    }
  }

  /// Clusters that tours can begin with, when that matters; else one stands for all.
  std::vector<int> roots() const {
    if (problem_.root >= 0 || problem_.before.empty()) return {problem_.root};
    std::vector<int> roots;
    for (std::size_t c = 0; c < problem_.before.size(); ++c) {
      if (problem_.before[c].empty()) roots.push_back(static_cast<int>(c));
    }
    return roots;
  }

  proof::SubsetProblem& problem() { return problem_; }
  int original(int v) const { return original_[at(v)]; }

 private:
  void append(const std::vector<int>& vertices, int cluster) {
    std::vector<int> numbers;
    for (const int v : vertices) {
      numbers.push_back(static_cast<int>(original_.size()));
      number_[at(v)] = numbers.back();
      original_.push_back(v);
    }
    problem_.clusters.push_back(std::move(numbers));
    cluster_.push_back(cluster);
  }

  void load_costs(const Instance& instance, const Anchor& anchor) {
    const std::size_t n = original_.size();
    problem_.cost.assign(n * n, kNoArc);
    for (std::size_t u = 0; u < n; ++u) {
      for_each_arc(instance, anchor, original_[u], [&](int to, double cost) {
        const int v = number_[at(to)];
        if (v >= 0) problem_.cost[u * n + at(v)] = cost;
      });
    }
  }

  std::vector<int> number_;    ///< by vertex of the instance; −1 = dropped
  std::vector<int> original_;  ///< by number
  std::vector<int> cluster_;   ///< of the instance, by cluster of the problem; −1 for the anchor's
  proof::SubsetProblem problem_;
};

}  // namespace

ExactAnswer solve_exactly(const Instance& instance, const Anchor& anchor, const Pruning& pruning,
                          const ExactParams& params, const StopCondition& stop) {
  const auto living = std::count(pruning.is_alive.begin(), pruning.is_alive.end(), 1);
  const auto fixed = std::count(anchor.fixed_cluster.begin(), anchor.fixed_cluster.end(), 1);
  const auto clusters = instance.cluster_count() - fixed + (anchor.is_used ? 1 : 0);
  if (living > proof::kMostSubsetVertices || clusters > proof::kMostSubsetClusters) return {};
  FoldedProblem folded(instance, anchor, pruning);
  folded.load_precedence(params.precedence);
  proof::SubsetProblem& problem = folded.problem();
  const std::vector<int> roots = folded.roots();
  ExactAnswer answer{ExactAnswer::Kind::kNoTour, {}, kNoArc};
  proof::SubsetLimits limits;
  limits.work = params.work / static_cast<double>(roots.size());
  for (const int root : roots) {
    problem.root = root;
    const proof::SubsetAnswer found = search_subsets(problem, limits, stop);
    answer.lower_bound = std::min(answer.lower_bound, found.lower_bound);
    if (found.kind == Kind::kStopped || found.kind == Kind::kTooMuch) {
      const bool is_stopped = found.kind == Kind::kStopped;
      return {is_stopped ? ExactAnswer::Kind::kStopped : ExactAnswer::Kind::kTooLarge,
              {},
              roots.size() == 1 ? found.lower_bound : 0.0};
    }
    if (found.kind != Kind::kTour) continue;
    limits.upper_bound = found.cost;
    answer = {ExactAnswer::Kind::kSolved, {}, found.cost};
    for (const int v : found.tour) answer.order.push_back(folded.original(v));
  }
  return answer;
}

}  // namespace swallowtail::gtsp::detail
