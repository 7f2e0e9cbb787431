#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "coverage/gtsp/proof/ng_walks.hpp"
#include "planner/base/stop.hpp"

namespace swallowtail::gtsp::proof {

/// Cheapest closed tour below a given cost by dynamic programming forward over (set of clusters visited,
/// vertex) [HELD-KARP], where states are dropped that the least walk back to the root cannot complete below
/// it [BALDACCI-MINGOZZI-ROBERTI].
class LabelSearch {
 public:
  static constexpr int kMaxClusters = 128;

  /// All arcs that tours below the limit use must be listed in the graph.
  LabelSearch(const WalkGraph& graph, NgWalks& walks, const std::vector<double>& price);

  enum class End {
    kSearched,  ///< the tour, if any, is the cheapest below the limit; without one there is none
    kTooMany,   ///< more states or work than allowed
    kStopped
  };
  struct Answer {
    End end = End::kSearched;
    std::vector<int> tour;  ///< vertices of the graph, root first
    double cost = kNoArc;
  };
  /// Considers tours that cost at most `limit`.
  Answer run(double limit, std::size_t max_states, double max_work, const StopCondition& stop);
  double work() const { return work_; }

 private:
  using Visited = std::array<std::uint64_t, 2>;
  struct Label {
    double cost = 0.0;
    double reduced = 0.0;  ///< cost − prices of the clusters visited
    Visited visited = {};
    int vertex = 0;
    int parent = -1;
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static bool has(const Visited& visited, int c) {
    return (visited[at(c / 64)] >> (static_cast<unsigned>(c) % 64) & 1) != 0;
  }
  End run_from(int root, std::size_t max_states, const StopCondition& stop);
  void load_completions(int layer);
  double completion(int vertex, const Visited& visited) const;
  void extend(int index, std::vector<Label>& next);
  void append(std::vector<Label>& next);
  void close(int root, std::size_t begin);

  const WalkGraph& graph_;
  NgWalks& walks_;
  const std::vector<double>& price_;
  double price_sum_ = 0.0;
  double tolerance_ = 0.0;
  double limit_ = 0.0;
  double max_work_ = 0.0;
  double work_ = 0.0;
  Answer best_;
  std::vector<Label> labels_;
  std::vector<std::vector<double>> completion_;  ///< by vertex and allowed memory: least way back
};

}  // namespace swallowtail::gtsp::proof
