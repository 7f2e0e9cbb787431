#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "planner/base/result.hpp"

namespace swallowtail::gtsp {

/// Cost of an arc that does not exist.
inline constexpr double kNoArc = std::numeric_limits<double>::infinity();

/// Largest cost an arc may have. Below it, sums of integer costs along any tour of up to 9,000 arcs are exact
/// in a double.
inline constexpr double kMaxArcCost = 1e12;

/// Whole costs up to this are held in 32 bits, a missing arc as kNoWeight.
inline constexpr std::int32_t kMaxWeight = 1 << 30;
inline constexpr std::int32_t kNoWeight = std::numeric_limits<std::int32_t>::max();

inline constexpr int kMaxVertices = 200'000;  ///< of any instance
inline constexpr int kMaxMatrixVertices =
    6'000;  ///< of an instance given as a full matrix (288 MB, half of it where costs are weights)

/// One end of an arc and its cost.
struct Arc {
  int to = 0;
  double cost = 0.0;
};

/// An arc as given to Instance::from_arcs.
struct ArcInput {
  int from = 0;
  int to = 0;
  double cost = 0.0;
};

/// Distances of TSPLIB [TSPLIB95 §2], all rounded to integers as it defines; kGeom is metres on a sphere,
/// coordinates in degrees.
enum class Metric { kEuc2D, kCeil2D, kGeo, kGeom, kAtt };

/// A site in the plane, or latitude and longitude for kGeo (degrees.minutes) and kGeom (degrees).
struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// A generalised travelling salesman problem: vertices 0 … n−1 in clusters 0 … m−1, each vertex in exactly
/// one, and costs of arcs. Arcs may be missing (kNoArc), whichever way the costs are given. Costs are finite,
/// 0 … kMaxArcCost; integers are exact. Immutable; copies are deep.
class Instance {
 public:
  using Clusters = std::vector<std::vector<int>>;

  /// Sparse: only the arcs listed exist; of parallel arcs the cheapest counts. Errors (kBadInput): no
  /// vertices, an id outside 0 … n−1, an empty cluster, a vertex in no cluster or in two, an arc from a
  /// vertex to itself, a cost out of range.
  static Result<Instance> from_arcs(int vertex_count, Clusters clusters, std::span<const ArcInput> arcs);

  /// Dense: costs is n×n, row = from, column = to, +infinity = no arc; the diagonal is ignored. Errors as
  /// from_arcs.
  static Result<Instance> from_matrix(int vertex_count, Clusters clusters, std::vector<double> costs);

  /// The same from rows as they are kept, without copying: those from v are arcs[first_arc[v]] up to
  /// arcs[first_arc[v + 1]], by ascending target. Errors as from_arcs, or rows that are not so.
  static Result<Instance> from_rows(Clusters clusters, std::vector<std::size_t> first_arc,
                                    std::vector<Arc> arcs);

  /// Complete: every arc exists at the metric's distance, computed when asked for. Errors as from_arcs, or a
  /// coordinate out of range.
  static Result<Instance> from_points(Clusters clusters, std::vector<Point> points, Metric metric);

  int vertex_count() const { return static_cast<int>(cluster_of_.size()); }
  int cluster_count() const { return static_cast<int>(clusters_.size()); }
  /// The vertices of a cluster, in the order given.
  std::span<const int> cluster(int c) const { return clusters_[static_cast<std::size_t>(c)]; }
  int cluster_of(int v) const { return cluster_of_[static_cast<std::size_t>(v)]; }

  /// Cost of the arc, kNoArc when there is none (always when from == to). O(log out-degree) sparse, O(1)
  /// dense.
  double cost(int from, int to) const;

  class ArcRange;
  /// The arcs that leave v, by ascending target: a range of Arc. Those of other than sparse instances are
  /// made on the fly.
  ArcRange arcs_from(int v) const;

  /// Whether every pair of distinct vertices has its arc without looking (instances given as points).
  bool is_complete() const { return kind_ == Kind::kPoints; }
  bool is_sparse() const { return kind_ == Kind::kArcs; }

  /// n×n, row = from; empty unless given as a matrix of whole costs up to kMaxWeight.
  std::span<const std::int32_t> weights() const { return weights_; }
  /// Whether an arc between clusters is missing; of an instance given as a matrix.
  bool is_matrix_lacking() const { return is_matrix_lacking_; }
  /// As the metric's distance wants them (radians on a sphere); empty unless given as points.
  std::span<const Point> points() const { return points_; }
  /// Of the points.
  Metric metric() const { return metric_; }

 private:
  enum class Kind { kArcs, kMatrix, kPoints };

  explicit Instance(Kind kind) : kind_(kind) {}
  Status set_clusters(int vertex_count, Clusters clusters);
  double point_cost(int from, int to) const;
  double matrix_cost(std::size_t entry) const {
    if (weights_.empty()) return matrix_[entry];
    return weights_[entry] == kNoWeight ? kNoArc : weights_[entry];
  }

  Kind kind_;
  Clusters clusters_;
  std::vector<int> cluster_of_;
  std::vector<std::size_t> first_arc_;  // n + 1
  std::vector<Arc> arcs_;
  std::vector<std::int32_t> weights_;  // of a matrix, or else
  std::vector<double> matrix_;         // its costs
  bool is_matrix_lacking_ = false;
  std::vector<Point> points_;
  Metric metric_ = Metric::kEuc2D;
};

/// See Instance::arcs_from. Valid as long as the instance.
class Instance::ArcRange {
 public:
  class Iterator {
   public:
    using value_type = Arc;
    using difference_type = std::ptrdiff_t;

    Iterator() = default;
    Iterator(const Instance* instance, int from, std::size_t index)
        : instance_(instance), from_(from), index_(index) {
      skip_missing();
    }
    Arc operator*() const;
    Iterator& operator++() {
      ++index_;
      skip_missing();
      return *this;
    }
    Iterator operator++(int) {
      Iterator old = *this;
      ++*this;
      return old;
    }
    bool operator==(const Iterator& other) const { return index_ == other.index_; }

   private:
    void skip_missing();

    const Instance* instance_ = nullptr;
    int from_ = 0;
    std::size_t index_ = 0;
  };

  ArcRange(const Instance* instance, int from) : instance_(instance), from_(from) {}
  Iterator begin() const;
  Iterator end() const;

 private:
  const Instance* instance_;
  int from_;
};

}  // namespace swallowtail::gtsp
