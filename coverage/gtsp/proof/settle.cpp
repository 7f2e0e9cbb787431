#include "coverage/gtsp/proof/settle.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coverage/gtsp/detail/incumbents.hpp"
#include "coverage/gtsp/proof/certificate.hpp"

namespace swallowtail::gtsp::proof {
namespace {

/// The tour's closing arcs that the anchor folds away count in its cost; what is left is the folded tour's.
double folded_cost(const Solution& solution, const detail::Anchor& anchor) {
  return solution.tour.empty() ? kNoArc : solution.cost - anchor.inner_cost;
}

void mark_optimal(Solution& solution, std::string reason) {
  solution.status = SolveStatus::kOptimal;
  solution.proved_optimal = true;
  solution.lower_bound = solution.cost;
  solution.reason = std::move(reason);
}

void take(const Instance& instance, const detail::Anchor& anchor, const Options& options,
          const Certificate& certificate, Solution& solution) {
  const auto same = [](int v) { return v; };
  const detail::Found found = detail::found_from(instance, anchor, certificate.order, same, options.kind);
  if (!options.precedence.empty()) {
    // The best tour without precedence: a bound on those with.
    solution.lower_bound = std::max(solution.lower_bound, found.cost);
    if (!solution.tour.empty() && solution.cost <= found.cost)
      mark_optimal(solution, "The tour costs no more than the best without precedence.");
    return;
  }
  if (found.cost < solution.cost) {
    solution.tour = found.tour;
    solution.cost = found.cost;
    const double now_s = solution.history.empty() ? 0.0 : solution.history.back().wall_s;
    solution.history.push_back({now_s, found.cost});
  }
  mark_optimal(solution, "All tours below the bound of priced walks were considered.");
}

/// Least way of one vertex of each cluster by `least(v)`, half of what leads there and away together.
template <class Least>
double sum_over_clusters(const Instance& instance, Least least) {
  double sum = 0.0;
  for (int c = 0; c < instance.cluster_count(); ++c) {
    double cheapest = kNoArc;
    for (const int v : instance.cluster(c)) cheapest = std::min(cheapest, least(v));
    sum += cheapest == kNoArc ? 0.0 : cheapest;
  }
  return sum;
}

double nearest_ways_by_arcs(const Instance& instance) {
  const auto n = static_cast<std::size_t>(instance.vertex_count());
  std::vector<double> in(n, kNoArc);
  std::vector<double> out(n, kNoArc);
  for (int u = 0; u < instance.vertex_count(); ++u) {
    for (const Arc arc : instance.arcs_from(u)) {
      if (instance.cluster_of(arc.to) == instance.cluster_of(u)) continue;
      double& into = in[static_cast<std::size_t>(arc.to)];
      double& out_of = out[static_cast<std::size_t>(u)];
      into = std::min(into, arc.cost);
      out_of = std::min(out_of, arc.cost);
    }
  }
  return (1.0 - 1e-12) * sum_over_clusters(instance, [&](int v) {
           return (in[static_cast<std::size_t>(v)] + out[static_cast<std::size_t>(v)]) / 2.0;
         });
}

/// The two nearest vertices of different other clusters, by sweeping outwards in x: a distance is at least
/// its part along x, less one for rounding.
class PlaneSweep {
 public:
  explicit PlaneSweep(const Instance& instance) : instance_(instance), order_(instance.points().size()) {
    std::iota(order_.begin(), order_.end(), 0);
    const auto& points = instance.points();
    std::sort(order_.begin(), order_.end(), [&](int a, int b) {
      const double xa = points[static_cast<std::size_t>(a)].x;
      const double xb = points[static_cast<std::size_t>(b)].x;
      return xa != xb ? xa < xb : a < b;
    });
    rank_.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) rank_[static_cast<std::size_t>(order_[i])] = i;
  }

  double half_of_two_nearest(int v) const {
    Nearest nearest;
    const std::size_t i = rank_[static_cast<std::size_t>(v)];
    for (std::size_t j = i; j-- > 0 && look(v, order_[j], nearest);) {
    }
    for (std::size_t j = i + 1; j < order_.size() && look(v, order_[j], nearest); ++j) {
    }
    return (nearest.first + (nearest.second == kNoArc ? nearest.first : nearest.second)) / 2.0;
  }

 private:
  struct Nearest {
    int cluster = -1;
    double first = kNoArc;
    double second = kNoArc;
  };

  /// False when no vertex further on can be nearer.
  bool look(int v, int other, Nearest& nearest) const {
    const auto& points = instance_.points();
    const double apart =
        std::abs(points[static_cast<std::size_t>(v)].x - points[static_cast<std::size_t>(other)].x);
    if (apart - 1.0 > nearest.second) return false;
    const int c = instance_.cluster_of(other);
    if (c == instance_.cluster_of(v)) return true;
    const double cost = instance_.cost(v, other);
    if (c == nearest.cluster) {
      nearest.first = std::min(nearest.first, cost);
    } else if (cost < nearest.first) {
      nearest.second = nearest.first;
      nearest.first = cost;
      nearest.cluster = c;
    } else {
      nearest.second = std::min(nearest.second, cost);
    }
    return true;
  }

  const Instance& instance_;
  std::vector<int> order_;
  std::vector<std::size_t> rank_;
};

}  // namespace

double nearest_ways(const Instance& instance) {
  const bool is_plane =
      instance.is_complete() && (instance.metric() == Metric::kEuc2D || instance.metric() == Metric::kCeil2D);
  if (!is_plane || instance.cluster_count() < 3) {
    return instance.vertex_count() <= kMaxMatrixVertices || instance.is_sparse()
               ? nearest_ways_by_arcs(instance)
               : 0.0;
  }
  const PlaneSweep sweep(instance);
  return std::ceil(sum_over_clusters(instance, [&](int v) { return sweep.half_of_two_nearest(v); }) - 1e-6);
}

void settle(const Instance& instance, const Options& options, double work, Solution& solution) {
  const bool is_open =
      solution.status == SolveStatus::kFeasible || solution.status == SolveStatus::kNoneFound;
  if (!is_open || work <= 0.0 || options.stop.reached(0, 0)) return;
  const detail::Anchor anchor = detail::make_anchor(instance, options);
  const double cells = static_cast<double>(instance.vertex_count()) * instance.cluster_count();
  if (cells > kMaxWalkCells) {
    if (!anchor.is_used) solution.lower_bound = std::max(solution.lower_bound, nearest_ways(instance));
    return;
  }
  const detail::Pruning pruning =
      instance.is_complete() ? detail::all_alive(instance, anchor) : detail::prune(instance, anchor);
  if (pruning.has_no_tour()) return;
  CertificateParams params;
  params.upper_bound = folded_cost(solution, anchor);
  params.work = work;
  const Certificate certificate = certify(instance, anchor, pruning, params, options.stop);
  switch (certificate.kind) {
    case Certificate::Kind::kOptimal:
      take(instance, anchor, options, certificate, solution);
      return;
    case Certificate::Kind::kProved:
      mark_optimal(solution, "No walk that costs less can be a tour.");
      return;
    case Certificate::Kind::kNoTour:
      solution.status = SolveStatus::kInfeasible;
      solution.lower_bound = kNoArc;
      solution.reason =
          "No walk over arcs that are there returns after visiting as many clusters as there are.";
      return;
    case Certificate::Kind::kBound:
      break;
  }
  solution.lower_bound = std::max(solution.lower_bound, anchor.inner_cost + certificate.lower_bound);
  const double rounding =
      certificate.rounding + 2e-10 * (certificate.rounding > 0.0 ? anchor.inner_cost : 0.0);
  if (!solution.tour.empty() && solution.cost <= solution.lower_bound + rounding)
    mark_optimal(solution, "The tour costs no more than the lower bound.");
}

}  // namespace swallowtail::gtsp::proof
