#include <algorithm>
#include <cmath>

#include "coverage/gtsp/detail/exact.hpp"
#include "coverage/gtsp/detail/pruning.hpp"
#include "coverage/gtsp/detail/run.hpp"
#include "coverage/gtsp/proof/certificate.hpp"

namespace swallowtail::gtsp::detail {
/// Tours in which nothing is left to choose.
bool Run::finish_trivial() {
  if (std::isinf(anchor_.inner_cost)) {
    finish_infeasible("Between the fixed vertices of the tour an arc is missing.");
    return true;
  }
  const auto is_all_fixed =
      std::find(anchor_.fixed_cluster.begin(), anchor_.fixed_cluster.end(), 0) == anchor_.fixed_cluster.end();
  if (!is_all_fixed && (anchor_.is_used || instance_.cluster_count() > 1)) return false;
  if (is_all_fixed && std::isinf(anchor_.self_cost)) {
    finish_infeasible("All vertices are fixed and the arc from the last fixed to the next is missing.");
    return true;
  }
  const std::vector<int> rest =
      is_all_fixed ? std::vector<int>{} : std::vector<int>{instance_.cluster(0).front()};
  finish({expanded(anchor_, rest), anchor_.inner_cost + anchor_.self_cost}, SolveStatus::kOptimal,
         "There is only one tour to consider.");
  return true;
}

std::string Run::name_of_cluster(int cluster) const {
  return cluster == instance_.cluster_count() ? "the fixed part" : "cluster " + std::to_string(cluster);
}

int Run::folded_clusters() const {
  const auto free = std::count(anchor_.fixed_cluster.begin(), anchor_.fixed_cluster.end(), 0);
  return static_cast<int>(free) + (anchor_.is_used ? 1 : 0);
}

/// What degrees, reachability and the bound prove.
bool Run::finish_unreachable() {
  pruning_ = instance_.is_complete() ? all_alive(instance_, anchor_) : prune(instance_, anchor_);
  if (pruning_->emptied_cluster >= 0) {
    finish_infeasible("Cluster " + std::to_string(pruning_->emptied_cluster) +
                      " has no vertex that arcs lead to and from within any tour.");
    return true;
  }
  if (pruning_->cutting_cluster >= 0) {
    finish_infeasible("Without cluster " + std::to_string(pruning_->cutting_cluster) +
                      " the others do not hang together: a tour would have to come through it twice.");
    return true;
  }
  if (pruning_->is_anchor_dead) {
    finish_infeasible("No arcs lead from or to the fixed part of the tour.");
    return true;
  }
  const Bound bound = lower_bound(instance_, anchor_, *pruning_);
  if (std::isinf(bound.value)) {
    finish_infeasible("Among the clusters with " + name_of_cluster(bound.starved_cluster) +
                      ", more have to be left than arcs lead to: not each can have a successor of its own.");
    return true;
  }
  solution_.lower_bound = anchor_.inner_cost + bound.value;
  rounding_ = bound.rounding + (bound.rounding > 0.0 ? 2e-10 * anchor_.inner_cost : 0.0);
  return false;
}

/// Subsets where they can be gone through, else priced walks.
bool Run::finish_exact() { return finish_by_subsets() || finish_by_walks(); }

/// Under a deadline, half of the time left at most.
StopCondition Run::stop_of_proofs() const {
  StopCondition stop = options_.stop;
  if (stop.clock != nullptr && std::isfinite(stop.deadline_s))
    stop.deadline_s = std::min(stop.deadline_s, (stop.deadline_s + stop.clock->now_s()) / 2.0);
  return stop;
}

bool Run::finish_by_subsets() {
  const ExactAnswer answer =
      solve_exactly(instance_, anchor_, *pruning_, {.work = effort_.exact_work}, stop_of_proofs());
  solution_.lower_bound = std::max(solution_.lower_bound, anchor_.inner_cost + answer.lower_bound);
  if (answer.kind == ExactAnswer::Kind::kNoTour) {
    finish_infeasible("All orders of the clusters were considered: each needs a missing arc.");
    return true;
  }
  if (answer.kind != ExactAnswer::Kind::kSolved) return false;
  const auto same = [](int v) { return v; };
  finish(found_from(instance_, anchor_, answer.order, same, options_.kind), SolveStatus::kOptimal,
         "Dynamic programming over all subsets of clusters.");
  return true;
}

bool Run::finish_by_walks() {
  constexpr int kMostClusters = 24;
  constexpr double kWalkShare = 0.08;  ///< a step takes about ten times as long
  if (effort_.exact_work == 0.0 || folded_clusters() > kMostClusters || options_.stop.reached(0, 0))
    return false;
  proof::CertificateParams params;
  params.work = kWalkShare * effort_.exact_work;
  const proof::Certificate certificate = proof::certify(instance_, anchor_, *pruning_, params, options_.stop);
  if (certificate.kind == proof::Certificate::Kind::kNoTour) {
    finish_infeasible(
        "No walk over arcs that are there returns after visiting as many clusters as there are.");
    return true;
  }
  if (certificate.kind == proof::Certificate::Kind::kOptimal) {
    const auto same = [](int v) { return v; };
    finish(found_from(instance_, anchor_, certificate.order, same, options_.kind), SolveStatus::kOptimal,
           "All tours below the bound of priced walks were considered.");
    return true;
  }
  solution_.lower_bound = std::max(solution_.lower_bound, anchor_.inner_cost + certificate.lower_bound);
  rounding_ = std::max(rounding_, certificate.rounding);
  return false;
}

}  // namespace swallowtail::gtsp::detail
