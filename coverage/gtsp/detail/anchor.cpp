#include "coverage/gtsp/detail/anchor.hpp"

namespace swallowtail::gtsp::detail {
namespace {

std::vector<int> lead_of(const Options& options) {
  if (options.fixed_prefix.empty() && options.start_vertex) return {*options.start_vertex};
  return options.fixed_prefix;
}

double inner_cost_of(const Instance& instance, const Anchor& anchor, TourKind kind) {
  double sum = 0.0;
  for (std::size_t i = 1; i < anchor.lead.size(); ++i)
    sum += instance.cost(anchor.lead[i - 1], anchor.lead[i]);
  const bool joins_ends = kind == TourKind::kClosed && anchor.end && !anchor.lead.empty();
  return joins_ends ? sum + instance.cost(*anchor.end, anchor.lead.front()) : sum;
}

double self_cost_of(const Instance& instance, const Anchor& anchor) {
  if (anchor.in_vertex == Anchor::kFree || anchor.out_vertex == Anchor::kFree ||
      anchor.in_vertex == anchor.out_vertex)
    return 0.0;
  return instance.cost(anchor.out_vertex, anchor.in_vertex);
}

}  // namespace

Anchor make_anchor(const Instance& instance, const Options& options) {
  Anchor anchor;
  anchor.lead = lead_of(options);
  const bool ends_in_lead =
      options.end_vertex && !anchor.lead.empty() && anchor.lead.back() == *options.end_vertex;
  if (!ends_in_lead) anchor.end = options.end_vertex;
  const bool is_closed = options.kind == TourKind::kClosed;
  anchor.is_used = !is_closed || !anchor.lead.empty() || anchor.end;
  if (!anchor.lead.empty()) {
    anchor.out_vertex = anchor.lead.back();
  } else if (is_closed && anchor.end) {
    anchor.out_vertex = *anchor.end;
  }
  if (anchor.end) {
    anchor.in_vertex = *anchor.end;
  } else if (is_closed && !anchor.lead.empty()) {
    anchor.in_vertex = anchor.lead.front();
  }
  anchor.inner_cost = inner_cost_of(instance, anchor, options.kind);
  anchor.self_cost = self_cost_of(instance, anchor);
  anchor.fixed_cluster.assign(static_cast<std::size_t>(instance.cluster_count()), 0);
  for (const int v : anchor.lead) anchor.fixed_cluster[static_cast<std::size_t>(instance.cluster_of(v))] = 1;
  if (anchor.end) anchor.fixed_cluster[static_cast<std::size_t>(instance.cluster_of(*anchor.end))] = 1;
  return anchor;
}

double arc_cost(const Instance& instance, const Anchor& anchor, int from, int to) {
  const int n = instance.vertex_count();
  const int source = from == n ? anchor.out_vertex : from;
  const int target = to == n ? anchor.in_vertex : to;
  if (source == Anchor::kFree || target == Anchor::kFree) return from == to ? kNoArc : 0.0;
  const bool is_inside = from != n && to != n && instance.cluster_of(from) == instance.cluster_of(to);
  return from == to || is_inside ? kNoArc : instance.cost(source, target);
}

std::vector<int> expanded(const Anchor& anchor, const std::vector<int>& rest) {
  std::vector<int> tour = anchor.lead;
  tour.insert(tour.end(), rest.begin(), rest.end());
  if (anchor.end) tour.push_back(*anchor.end);
  return tour;
}

}  // namespace swallowtail::gtsp::detail
