#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "coverage/gtsp/detail/anchor.hpp"
#include "coverage/gtsp/detail/pruning.hpp"

namespace swallowtail::gtsp::detail {

/// Missing arcs first, then cost: how tours that are not yet tours compare.
struct Score {
  int missing = 0;
  double cost = 0.0;

  void add(double arc) {
    if (std::isinf(arc)) {
      ++missing;
    } else {
      cost += arc;
    }
  }
  void subtract(double arc) {
    if (std::isinf(arc)) {
      --missing;
    } else {
      cost -= arc;
    }
  }
  friend bool operator<(const Score& a, const Score& b) {
    return a.missing != b.missing ? a.missing < b.missing : a.cost < b.cost;
  }
};

/// What the search works on: the folded instance without its hopeless vertices, numbered so that each
/// cluster's vertices are consecutive. Costs are floats (exact for integers to 2^24; found tours are summed
/// again on the instance) in a full matrix, and in its transpose if they are not symmetric, so that one
/// cluster's costs from or to a vertex stand side by side.
class Reduced {
 public:
  /// Needs at least two clusters left to visit (the anchor counts) and no emptied one.
  Reduced(const Instance& instance, const Anchor& anchor, const Pruning& pruning);

  int size() const { return static_cast<int>(original_.size()); }
  int cluster_count() const { return static_cast<int>(first_.size()) - 1; }
  int first(int c) const { return first_[at(c)]; }
  int last(int c) const { return first_[at(c) + 1]; }  ///< one past
  int cluster_size(int c) const { return last(c) - first(c); }
  int cluster_of(int v) const { return cluster_of_[at(v)]; }
  /// Vertex of the instance; its vertex count for the anchor.
  int original(int v) const { return original_[at(v)]; }
  /// Vertex here of a vertex of the instance, −1 if it was dropped.
  int reduced(int original) const { return reduced_[at(original)]; }
  int anchor() const { return anchor_; }  ///< −1 when there is none

  const float* out_row(int v) const { return out_.data() + at(v) * original_.size(); }
  const float* in_row(int v) const { return (is_symmetric_ ? out_ : in_).data() + at(v) * original_.size(); }
  float cost(int from, int to) const { return out_row(from)[to]; }
  bool is_symmetric() const { return is_symmetric_; }

  /// By vertex u: least cost from u to a vertex of c, and from one of c to u.
  const float* least_out(int c) const { return least_out_.data() + at(c) * original_.size(); }
  const float* least_in(int c) const {
    return (is_symmetric_ ? least_out_ : least_in_).data() + at(c) * original_.size();
  }
  /// Least exact cost from a vertex of one cluster to one of the other.
  double least_arc(int from_cluster, int to_cluster) const {
    return least_arc_[at(from_cluster) * (first_.size() - 1) + at(to_cluster)];
  }
  /// Nearest other clusters in either direction, nearest first; at most kNeighbours.
  const std::vector<int>& neighbours(int c) const { return neighbours_[at(c)]; }
  static constexpr int kNeighbours = 60;

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void number_vertices(const Instance& instance, const Pruning& pruning);
  void fill(const Instance& instance, const Anchor& anchor);
  void find_symmetry();
  void find_least();
  void find_neighbours();

  std::vector<int> first_;
  std::vector<int> cluster_of_;
  std::vector<int> original_;
  std::vector<int> reduced_;
  int anchor_ = -1;
  bool is_symmetric_ = false;
  std::vector<float> out_;
  std::vector<float> in_;
  std::vector<float> least_out_;
  std::vector<float> least_in_;
  std::vector<double> least_arc_;
  std::vector<std::vector<int>> neighbours_;
};

}  // namespace swallowtail::gtsp::detail
