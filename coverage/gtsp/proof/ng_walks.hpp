#pragma once

#include <optional>
#include <span>
#include <vector>

#include "coverage/gtsp/proof/walk_graph.hpp"

namespace swallowtail::gtsp::proof {

/// Cheapest walks over the clusters that need not visit each once: a cluster may come again once the walk has
/// forgotten it. What a walk at cluster c remembers of the clusters it visited is what it remembered before
/// and is in memory(c). An arc costs its cost less the price of the cluster it leads to.
/// Source: the ng-route relaxation of [BALDACCI-MINGOZZI-ROBERTI], with clusters in the place of vertices.
/// Over arcs that the graph does not list all is forgotten.
class NgWalks {
 public:
  /// The graph must outlive this, and rememorise() be called again after its lists of arcs change.
  explicit NgWalks(const WalkGraph& graph) : graph_(graph) {}

  static constexpr int kMaxMemory = 13;  ///< clusters, itself counted

  /// memory[c] begins with c; at most kMaxMemory clusters each. False, and nothing changed, when the values
  /// of one pass would take more than `max_bytes`.
  bool rememorise(std::vector<std::vector<int>> memory, double max_bytes);
  const std::vector<std::vector<int>>& memory() const { return memory_; }
  /// Elementary steps of one layer of a pass.
  double layer_work() const;
  double pass_work() const { return layer_work() * graph_.cluster_count(); }

  /// Least sum over closed walks of as many arcs as there are clusters, from a vertex of the root cluster,
  /// which is not visited in between, to one of it, the same or not; kNoArc when there is none.
  double forward(std::span<const double> price);
  /// The same value, found from the end; of walks from and to the root vertex `root`, if given.
  double backward(std::span<const double> price, std::optional<int> root);

  struct Walk {
    std::vector<int> vertices;
    std::vector<WalkGraph::Bundle> leaps;  ///< arcs that are not listed
  };
  /// The walk that the last forward() found, from root to root.
  Walk least_walk() const;

  /// Least value of a walk's first k arcs that end at v, and of its arcs from v at position k on, whatever is
  /// remembered.
  double least_to(int k, int v) const { return least(ahead_, k, v); }
  double least_from(int k, int v) const { return least(back_, graph_.cluster_count() - k, v); }
  /// The latter by what is remembered of the clusters ahead: index bit i = memory[c][i + 1].
  std::span<const double> from_states(int k, int v) const {
    return states(back_, graph_.cluster_count() - k, v);
  }

  /// Least sums over walks of `arcs` arcs from each cluster to anywhere, the root being as the others, where
  /// a walk gains the potential of the state it ends in and pays that of the one it begins in. A tour's walks
  /// from all clusters are worth `arcs` times the tour: potentials cancel.
  std::vector<double> windows(std::span<const double> price, int arcs);
  /// The walk that the last windows() found from cluster c.
  Walk window(int c) const;
  /// By state, finite, zero at first. What walks may look forward to beyond a window: moved by `share` of the
  /// way to what the last windows() found from each state.
  void learn_potentials(double share);
  const std::vector<double>& potentials() const { return potential_; }
  /// Whether every tour forgets each cluster before it comes back to it. Otherwise windows with potentials
  /// do not bound tours, and only those of fewer arcs than there are clusters, without potentials, do.
  bool forgets_all() const;
  void set_potentials(std::vector<double> potential) { potential_ = std::move(potential); }

 private:
  /// Values by layer and state; a vertex's states lie side by side.
  struct Pass {
    std::vector<double> value;
    int last = 0;  ///< layer
  };
  struct Origin {
    int state = 0;
    bool is_leap = false;
  };
  /// What may be remembered before going on, and is then.
  struct Move {
    int before = 0;
    int after = 0;
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int masks(int v) const { return 1 << (memory_[at(graph_.cluster_of(v))].size() - 1); }
  std::size_t state_count() const { return first_state_.back(); }
  const double* layer(const Pass& pass, int i) const { return pass.value.data() + at(i) * state_count(); }
  std::span<const double> states(const Pass& pass, int i, int v) const {
    return {layer(pass, i) + first_state_[at(v)], at(masks(v))};
  }
  double least(const Pass& pass, int i, int v) const;
  const int* table(int from_cluster, int to_cluster) const {
    return tables_.data() + table_[at(from_cluster) * at(graph_.cluster_count()) + at(to_cluster)];
  }
  std::span<const Move> moves(int from_cluster, int to_cluster) const {
    const std::size_t pair = at(from_cluster) * at(graph_.cluster_count()) + at(to_cluster);
    return std::span(moves_).subspan(at(first_move_[pair]), at(move_count_[pair]));
  }
  void tabulate(int from_cluster, int to_cluster);
  void carry_potentials(const std::vector<std::vector<int>>& old_memory,
                        const std::vector<std::size_t>& old_first_state);
  double weight(double cost, int into_cluster) const { return cost - price_[at(into_cluster)]; }

  void begin(Pass& pass, std::span<const double> price, int layers);
  bool may_enter(int cluster, int i) const {
    return !is_closed_ || (cluster == graph_.root()) == (i == graph_.cluster_count());
  }
  template <bool kIsForward>
  void step(Pass& pass, int i);
  void note_least(const Pass& pass, int i);
  void leap_forward(Pass& pass, int i);
  void leap_backward(Pass& pass, int i);
  double end(const Pass& pass, std::optional<int> root) const;
  Origin forward_origin(int i, int state) const;
  Origin backward_origin(int i, int state) const;

  const WalkGraph& graph_;
  std::vector<double> price_;
  std::vector<std::vector<int>> memory_;
  std::vector<std::size_t> first_state_;  ///< n + 1
  std::vector<int> vertex_of_state_;
  std::vector<int> table_;       ///< by cluster pair: where its table begins in tables_, −1 = none
  std::vector<int> tables_;      ///< what is remembered after going on, −1 = not allowed
  std::vector<int> first_move_;  ///< by cluster pair
  std::vector<int> move_count_;
  std::vector<Move> moves_;
  bool is_closed_ = true;
  Pass ahead_;
  Pass back_;
  std::vector<double> least_;  ///< scratch: by vertex, of one layer
  std::vector<double> potential_;
  std::vector<int> window_state_;  ///< by cluster: where its least window begins
};

}  // namespace swallowtail::gtsp::proof
