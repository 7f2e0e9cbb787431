#include "coverage/gtsp/instance.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "coverage/gtsp/detail/metric.hpp"
#include "planner/base/checks.hpp"

namespace swallowtail::gtsp {
namespace {

std::string name_of_arc(int from, int to) {
  return "Arc " + std::to_string(from) + " -> " + std::to_string(to);
}

Status check_cost(int from, int to, double cost) {
  if (is_within(cost, 0.0, kMaxArcCost)) return {};
  return bad_input(name_of_arc(from, to) + " has cost " + std::to_string(cost) +
                   "; it must be finite, from 0 to 1e12.");
}

Status check_arc(const ArcInput& arc, int vertex_count) {
  if (arc.from < 0 || arc.from >= vertex_count || arc.to < 0 || arc.to >= vertex_count) {
    return bad_input(name_of_arc(arc.from, arc.to) + " names a vertex outside 0 to " +
                     std::to_string(vertex_count - 1) + ".");
  }
  if (arc.from == arc.to)
    return bad_input(name_of_arc(arc.from, arc.to) + " leads from a vertex to itself; it must join two.");
  return check_cost(arc.from, arc.to, arc.cost);
}

std::size_t index(int i) { return static_cast<std::size_t>(i); }

}  // namespace

Status Instance::set_clusters(int vertex_count, Clusters clusters) {
  if (vertex_count < 1 || vertex_count > kMaxVertices) {
    return bad_input("The instance has " + std::to_string(vertex_count) + " vertices; it must have 1 to " +
                     std::to_string(kMaxVertices) + ".");
  }
  cluster_of_.assign(index(vertex_count), -1);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    if (clusters[c].empty())
      return bad_input("Cluster " + std::to_string(c) + " is empty; each must hold a vertex.");
    for (const int v : clusters[c]) {
      const std::string place = "Vertex " + std::to_string(v) + " of cluster " + std::to_string(c);
      if (v < 0 || v >= vertex_count)
        return bad_input(place + " is outside 0 to " + std::to_string(vertex_count - 1) + ".");
      int& owner = cluster_of_[index(v)];
      if (owner >= 0) {
        return bad_input(place + " is also in cluster " + std::to_string(owner) +
                         "; it must be in exactly one.");
      }
      owner = static_cast<int>(c);
    }
  }
  const auto orphan = std::find(cluster_of_.begin(), cluster_of_.end(), -1);
  if (orphan != cluster_of_.end()) {
    return bad_input("Vertex " + std::to_string(orphan - cluster_of_.begin()) +
                     " is in no cluster; it must be in exactly one.");
  }
  clusters_ = std::move(clusters);
  return {};
}

Result<Instance> Instance::from_arcs(int vertex_count, Clusters clusters, std::span<const ArcInput> arcs) {
  Instance instance(Kind::kArcs);
  if (Status s = instance.set_clusters(vertex_count, std::move(clusters)); !s) return s.error();
  instance.first_arc_.assign(index(vertex_count) + 1, 0);
  for (const ArcInput& arc : arcs) {
    if (Status s = check_arc(arc, vertex_count); !s) return s.error();
    ++instance.first_arc_[index(arc.from) + 1];
  }
  for (std::size_t v = 0; v < index(vertex_count); ++v) instance.first_arc_[v + 1] += instance.first_arc_[v];
  std::vector<std::size_t> next(instance.first_arc_.begin(), instance.first_arc_.end() - 1);
  instance.arcs_.resize(arcs.size());
  for (const ArcInput& arc : arcs) instance.arcs_[next[index(arc.from)]++] = {arc.to, arc.cost};

  std::size_t kept = 0;
  std::size_t begin = 0;
  for (std::size_t v = 0; v < index(vertex_count); ++v) {
    const std::size_t end = instance.first_arc_[v + 1];
    const auto row = std::span(instance.arcs_).subspan(begin, end - begin);
    std::sort(row.begin(), row.end(),
              [](const Arc& a, const Arc& b) { return a.to != b.to ? a.to < b.to : a.cost < b.cost; });
    const std::size_t row_start = kept;
    for (const Arc& arc : row) {
      const bool is_parallel = kept > row_start && instance.arcs_[kept - 1].to == arc.to;
      if (!is_parallel) instance.arcs_[kept++] = arc;
    }
    begin = end;
    instance.first_arc_[v + 1] = kept;
  }
  instance.arcs_.resize(kept);
  return instance;
}

Result<Instance> Instance::from_rows(Clusters clusters, std::vector<std::size_t> first_arc,
                                     std::vector<Arc> arcs) {
  Instance instance(Kind::kArcs);
  if (first_arc.size() < 2 || first_arc.front() != 0 || first_arc.back() != arcs.size() ||
      !std::is_sorted(first_arc.begin(), first_arc.end()))
    return bad_input("The rows must begin at arc 0, end with the last, and follow one another.");
  const auto vertex_count = static_cast<int>(first_arc.size() - 1);
  if (Status s = instance.set_clusters(vertex_count, std::move(clusters)); !s) return s.error();
  for (int v = 0; v < vertex_count; ++v) {
    int before = -1;
    for (std::size_t i = first_arc[index(v)]; i < first_arc[index(v) + 1]; ++i) {
      if (Status s = check_arc({v, arcs[i].to, arcs[i].cost}, vertex_count); !s) return s.error();
      if (arcs[i].to <= before)
        return bad_input(name_of_arc(v, arcs[i].to) + " stands behind one to a vertex not below it.");
      before = arcs[i].to;
    }
  }
  instance.first_arc_ = std::move(first_arc);
  instance.arcs_ = std::move(arcs);
  return instance;
}

Result<Instance> Instance::from_matrix(int vertex_count, Clusters clusters, std::vector<double> costs) {
  Instance instance(Kind::kMatrix);
  if (vertex_count > kMaxMatrixVertices) {
    return bad_input("The matrix has " + std::to_string(vertex_count) + " rows; it may have at most " +
                     std::to_string(kMaxMatrixVertices) + ".");
  }
  if (Status s = instance.set_clusters(vertex_count, std::move(clusters)); !s) return s.error();
  const std::size_t n = index(vertex_count);
  if (costs.size() != n * n) {
    return bad_input("The matrix has " + std::to_string(costs.size()) + " entries; " +
                     std::to_string(vertex_count) + " vertices need " + std::to_string(n * n) + ".");
  }
  bool are_weights = true;
  for (int from = 0; from < vertex_count; ++from) {
    for (int to = 0; to < vertex_count; ++to) {
      double& cost = costs[index(from) * n + index(to)];
      if (from == to) cost = kNoArc;
      if (cost == kNoArc) {
        if (instance.cluster_of(from) != instance.cluster_of(to)) instance.is_matrix_lacking_ = true;
        continue;
      }
      if (Status s = check_cost(from, to, cost); !s) return s.error();
      are_weights = are_weights && cost <= kMaxWeight && cost == std::floor(cost);
    }
  }
  if (!are_weights) {
    instance.matrix_ = std::move(costs);
    return instance;
  }
  instance.weights_.reserve(costs.size());
  for (const double cost : costs)
    instance.weights_.push_back(cost == kNoArc ? kNoWeight : static_cast<std::int32_t>(cost));
  return instance;
}

Result<Instance> Instance::from_points(Clusters clusters, std::vector<Point> points, Metric metric) {
  Instance instance(Kind::kPoints);
  if (points.size() > index(kMaxVertices)) {
    return bad_input("The instance has " + std::to_string(points.size()) + " points; it may have at most " +
                     std::to_string(kMaxVertices) + ".");
  }
  if (Status s = instance.set_clusters(static_cast<int>(points.size()), std::move(clusters)); !s)
    return s.error();
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double limit = metric == Metric::kGeo || metric == Metric::kGeom ? 360.0 : 1e11;
    if (!is_within(points[v].x, -limit, limit) || !is_within(points[v].y, -limit, limit)) {
      return bad_input("Vertex " + std::to_string(v) + " is at (" + std::to_string(points[v].x) + ", " +
                       std::to_string(points[v].y) + "); coordinates must be finite and within " +
                       std::to_string(limit) + ".");
    }
    points[v] = detail::prepared_point(points[v], metric);
  }
  instance.points_ = std::move(points);
  instance.metric_ = metric;
  return instance;
}

double Instance::point_cost(int from, int to) const {
  return detail::distance(points_[index(from)], points_[index(to)], metric_);
}

double Instance::cost(int from, int to) const {
  if (from == to) return kNoArc;
  if (kind_ == Kind::kMatrix) return matrix_cost(index(from) * cluster_of_.size() + index(to));
  if (kind_ == Kind::kPoints) return point_cost(from, to);
  const auto begin = arcs_.begin() + static_cast<std::ptrdiff_t>(first_arc_[index(from)]);
  const auto end = arcs_.begin() + static_cast<std::ptrdiff_t>(first_arc_[index(from) + 1]);
  const auto found = std::lower_bound(begin, end, to, [](const Arc& arc, int v) { return arc.to < v; });
  return found != end && found->to == to ? found->cost : kNoArc;
}

Instance::ArcRange Instance::arcs_from(int v) const { return {this, v}; }

Instance::ArcRange::Iterator Instance::ArcRange::begin() const {
  return {instance_, from_, instance_->is_sparse() ? instance_->first_arc_[index(from_)] : 0};
}

Instance::ArcRange::Iterator Instance::ArcRange::end() const {
  return {instance_, from_,
          instance_->is_sparse() ? instance_->first_arc_[index(from_) + 1] : instance_->cluster_of_.size()};
}

Arc Instance::ArcRange::Iterator::operator*() const {
  if (instance_->is_sparse()) return instance_->arcs_[index_];
  const int to = static_cast<int>(index_);
  return {to, instance_->cost(from_, to)};
}

void Instance::ArcRange::Iterator::skip_missing() {
  if (instance_->is_sparse()) return;
  const std::size_t n = instance_->cluster_of_.size();
  if (instance_->kind_ == Kind::kPoints) {
    if (index_ == index(from_)) ++index_;
    return;
  }
  while (index_ < n && instance_->matrix_cost(index(from_) * n + index_) == kNoArc) ++index_;
}

}  // namespace swallowtail::gtsp
