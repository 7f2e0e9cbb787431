#include "coverage/gtsp/check_tour.hpp"

#include <algorithm>
#include <string>

namespace swallowtail::gtsp {
namespace {

std::optional<double> arc_cost(const Instance& instance, int from, int to) {
  for (const Arc arc : instance.arcs_from(from)) {
    if (arc.to == to) return arc.cost;
  }
  return std::nullopt;
}

Status check_visits(const Instance& instance, std::span<const int> tour) {
  std::vector<int> visits(static_cast<std::size_t>(instance.cluster_count()), 0);
  for (const int v : tour) {
    if (v < 0 || v >= instance.vertex_count())
      return infeasible("The tour names vertex " + std::to_string(v) + ", which is not there.");
    for (int c = 0; c < instance.cluster_count(); ++c) {
      const auto members = instance.cluster(c);
      visits[static_cast<std::size_t>(c)] += static_cast<int>(std::count(members.begin(), members.end(), v));
    }
  }
  for (std::size_t c = 0; c < visits.size(); ++c) {
    if (visits[c] != 1) {
      return infeasible("Cluster " + std::to_string(c) + " is visited " + std::to_string(visits[c]) +
                        " times; it must be once.");
    }
  }
  return {};
}

Status check_rule(std::span<const int> tour, const TourRule& rule) {
  for (std::size_t i = 0; i < rule.prefix.size(); ++i) {
    if (i >= tour.size() || tour[i] != rule.prefix[i]) {
      return infeasible("Vertex " + std::to_string(rule.prefix[i]) + " is not number " + std::to_string(i) +
                        " of the tour, as the prefix asks.");
    }
  }
  if (rule.start && tour.front() != *rule.start)
    return infeasible("The tour does not start at vertex " + std::to_string(*rule.start) + ".");
  if (rule.end && tour.back() != *rule.end)
    return infeasible("The tour does not end at vertex " + std::to_string(*rule.end) + ".");
  return {};
}

Status check_precedence(const Instance& instance, std::span<const int> tour, const TourRule& rule) {
  const auto place_of = [&](int cluster) {
    const auto members = instance.cluster(cluster);
    return std::find_if(tour.begin(), tour.end(),
                        [&](int v) { return std::find(members.begin(), members.end(), v) != members.end(); });
  };
  for (const auto& [first, second] : rule.precedence) {
    if (place_of(first) < place_of(second)) continue;
    return infeasible("Cluster " + std::to_string(first) + " does not come before cluster " +
                      std::to_string(second) + ", as precedence asks.");
  }
  return {};
}

}  // namespace

Result<double> check_tour(const Instance& instance, std::span<const int> tour, const TourRule& rule) {
  if (Status s = check_visits(instance, tour); !s) return s.error();
  if (Status s = check_rule(tour, rule); !s) return s.error();
  if (Status s = check_precedence(instance, tour, rule); !s) return s.error();
  double sum = 0.0;
  const std::size_t arcs = rule.returns_to_start && tour.size() > 1 ? tour.size() : tour.size() - 1;
  for (std::size_t i = 0; i < arcs; ++i) {
    const int from = tour[i];
    const int to = tour[(i + 1) % tour.size()];
    const auto cost = arc_cost(instance, from, to);
    if (!cost)
      return infeasible("The tour uses arc " + std::to_string(from) + " -> " + std::to_string(to) +
                        ", which is not there.");
    sum += *cost;
  }
  return sum;
}

}  // namespace swallowtail::gtsp
