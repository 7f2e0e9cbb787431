#pragma once

#include <compare>
#include <functional>
#include <span>
#include <vector>

#include "coverage/gtsp/detail/anchor.hpp"
#include "coverage/gtsp/detail/pruning.hpp"

namespace swallowtail::gtsp::proof {

/// The folded instance as what bounds and exact methods walk on: vertices that can be part of a tour,
/// numbered so that each cluster's are consecutive, and a list of arcs out of each. Arcs that are not listed
/// are still there: `beyond` bounds them from below.
class WalkGraph {
 public:
  struct Arc {
    int to = 0;
    double cost = 0.0;
  };

  /// At least two clusters (the anchor counts) must be left to visit, none of them emptied.
  WalkGraph(const Instance& instance, const detail::Anchor& anchor, const detail::Pruning& pruning);

  int size() const { return static_cast<int>(original_.size()); }
  int cluster_count() const { return static_cast<int>(first_.size()) - 1; }
  int cluster_of(int v) const { return cluster_of_[at(v)]; }
  int first(int c) const { return first_[at(c)]; }
  int last(int c) const { return first_[at(c) + 1]; }  ///< one past
  /// Vertex of the instance; its vertex count for the anchor.
  int original(int v) const { return original_[at(v)]; }
  /// The cluster that walks begin and end in: the anchor's, or else the one with the fewest vertices.
  int root() const { return root_; }
  /// Whether all costs are integers.
  bool is_integer() const { return is_integer_; }

  /// Arcs that cost more than `most` count as not there in lists made from now on.
  void leave_out_above(double most) { most_cost_ = most; }
  /// Lists the arcs out of each vertex that are among its `per_vertex` least by cost − price of the cluster
  /// they lead to; O(n²) for complete instances.
  void list_cheapest(std::span<const double> price, int per_vertex);
  /// Lists the arcs that `keep(from, to, cost)` wants; the others count as not there from now on. False, and
  /// nothing changed, when they would be more than `limit`.
  bool list_only(const std::function<bool(int, int, double)>& keep, std::size_t limit);

  /// Lists the arcs from a vertex into a cluster as well.
  struct Bundle {
    int from = 0;
    int cluster = 0;
    friend auto operator<=>(const Bundle&, const Bundle&) = default;
  };
  void list_also(std::vector<Bundle> bundles);

  std::span<const Arc> out(int v) const { return row(out_first_, out_, v); }
  std::span<const Arc> in(int v) const { return row(in_first_, in_, v); }  ///< Arc::to is where it comes from
  std::size_t listed() const { return out_.size(); }
  /// Whether some arcs are not listed. Then beyond(v)[c] is the least cost of those out of v into cluster c.
  bool has_beyond() const { return !beyond_.empty(); }
  std::span<const double> beyond(int v) const {
    return std::span(beyond_).subspan(at(v) * at(cluster_count()), at(cluster_count()));
  }

  /// Least cost, by cluster pair [from·m + to], over the listed arcs.
  std::vector<double> least_listed() const;

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static std::span<const Arc> row(const std::vector<std::size_t>& first, const std::vector<Arc>& arcs,
                                  int v) {
    return std::span(arcs).subspan(first[at(v)], first[at(v) + 1] - first[at(v)]);
  }
  template <class Visit>
  void for_each_arc(int from, Visit visit) const;
  void number_vertices(const detail::Pruning& pruning);
  void look_for_fractions();
  void list_in();

  const Instance& instance_;
  const detail::Anchor& anchor_;
  std::vector<int> first_;
  std::vector<int> cluster_of_;
  std::vector<int> original_;
  std::vector<int> number_;  ///< by vertex of the instance; −1 = dropped
  int root_ = 0;
  bool is_integer_ = true;
  std::vector<std::size_t> out_first_;
  std::vector<Arc> out_;
  std::vector<std::size_t> in_first_;
  std::vector<Arc> in_;
  std::vector<double> beyond_;  ///< least cost by vertex and cluster [v·m + c] of arcs not listed
  double most_cost_ = kNoArc;
};

}  // namespace swallowtail::gtsp::proof
