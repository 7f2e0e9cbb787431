#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "coverage/gtsp/detail/anchor.hpp"
#include "coverage/gtsp/detail/pruning.hpp"
#include "coverage/gtsp/search/costs.hpp"

namespace swallowtail::gtsp::search {

/// A vertex near another and the cost of the arc between them.
struct Near {
  int vertex = 0;
  Cost cost = 0;
};

/// What the search works on: the folded instance (see Anchor) without its hopeless vertices, numbered so that
/// each cluster's vertices are consecutive, neighbours in space near each other in memory. Costs are whole
/// numbers: the instance's own if they are and fit, else rounded to 2^-30 of the largest; found tours are
/// summed again on the instance. Held as a matrix of 32 bits, the instance's own where that is numbered
/// likewise (it must outlive the problem), or, for points beyond kMaxPointMatrix vertices, computed when
/// asked for; of sparse instances beyond kMaxSparseMatrix vertices as lists of their arcs.
class Problem {
 public:
  Problem(const Instance& instance, const detail::Anchor& anchor, const detail::Pruning& pruning);
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  int size() const { return static_cast<int>(original_.size()); }
  int cluster_count() const { return static_cast<int>(first_.size()) - 1; }
  int first(int c) const { return first_[at(c)]; }
  int last(int c) const { return first_[at(c) + 1]; }  ///< one past
  int cluster_size(int c) const { return last(c) - first(c); }
  int cluster_of(int v) const { return cluster_of_[at(v)]; }
  const std::vector<int>& cluster_of() const { return cluster_of_; }
  /// Vertex of the instance; its vertex count for the anchor.
  int original(int v) const { return original_[at(v)]; }
  /// Vertex here of a vertex of the instance, −1 if it was dropped.
  int numbered(int original) const { return numbered_[at(original)]; }
  int original_count() const { return static_cast<int>(numbered_.size()) - 1; }
  int anchor() const { return anchor_; }  ///< −1 when there is none
  bool is_symmetric() const { return is_symmetric_; }
  bool has_missing() const { return has_missing_; }
  /// Empty unless costs are computed from them.
  const std::vector<Point>& points() const { return points_; }
  Metric metric() const { return metric_; }
  /// Of the arcs that leave each vertex and of those that lead there; empty unless held so.
  const ArcLists& arcs_out() const { return arcs_out_; }
  const ArcLists& arcs_into() const { return is_symmetric_ ? arcs_out_ : arcs_into_; }
  /// Row = from; what it says within clusters means nothing. Empty when there are points or lists.
  std::span<const std::int32_t> weights() const { return weights_; }

  /// Calls use(costs) with the costs in their own type.
  template <class Use>
  decltype(auto) with_costs(Use use) const {
    if (!arcs_out_.empty()) return use(ListCosts(&arcs_out_));
    if (points_.empty()) return use(MatrixCosts(weights_.data(), size()));
    switch (metric_) {
      case Metric::kEuc2D:
        return use(PointCosts<Metric::kEuc2D>(points_.data()));
      case Metric::kCeil2D:
        return use(PointCosts<Metric::kCeil2D>(points_.data()));
      case Metric::kGeo:
        return use(PointCosts<Metric::kGeo>(points_.data()));
      case Metric::kGeom:
        return use(PointCosts<Metric::kGeom>(points_.data()));
      case Metric::kAtt:
        break;
    }
    return use(PointCosts<Metric::kAtt>(points_.data()));
  }

  static constexpr int kMaxPointMatrix = 3'000;
  static constexpr int kMaxSparseMatrix = 8'192;

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void number_vertices(const Instance& instance, const detail::Pruning& pruning);
  void fill_from_points(const Instance& instance);
  void take_weights(const Instance& instance);
  double scale_of(const Instance& instance, const detail::Anchor& anchor) const;
  void fill_from_arcs(const Instance& instance, const detail::Anchor& anchor);
  void list_arcs(const Instance& instance, const detail::Anchor& anchor);
  bool lacks_arcs() const;
  bool looks_symmetric() const;

  std::vector<int> first_;
  std::vector<int> cluster_of_;
  std::vector<int> original_;
  std::vector<int> numbered_;
  int anchor_ = -1;
  bool is_symmetric_ = true;
  bool has_missing_ = false;
  std::vector<std::int32_t> own_weights_;
  std::span<const std::int32_t> weights_;
  ArcLists arcs_out_;
  ArcLists arcs_into_;
  std::vector<Point> points_;
  Metric metric_ = Metric::kEuc2D;
};

}  // namespace swallowtail::gtsp::search
