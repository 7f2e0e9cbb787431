#include "coverage/gtsp/proof/walk_graph.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::gtsp::proof {

WalkGraph::WalkGraph(const Instance& instance, const detail::Anchor& anchor, const detail::Pruning& pruning)
    : instance_(instance), anchor_(anchor) {
  number_vertices(pruning);
  look_for_fractions();
  out_first_.assign(original_.size() + 1, 0);
  in_first_ = out_first_;
}

void WalkGraph::number_vertices(const detail::Pruning& pruning) {
  const int n = instance_.vertex_count();
  number_.assign(at(n) + 1, -1);
  const auto append = [&](int v) {
    number_[at(v)] = size();
    original_.push_back(v);
    cluster_of_.push_back(static_cast<int>(first_.size()) - 1);
  };
  first_ = {0};
  for (int c = 0; c < instance_.cluster_count(); ++c) {
    for (const int v : instance_.cluster(c)) {
      if (pruning.is_alive[at(v)] != 0) append(v);
    }
    if (size() > first_.back()) first_.push_back(size());
  }
  for (int c = 1; c < cluster_count(); ++c) {
    if (last(c) - first(c) < last(root_) - first(root_)) root_ = c;
  }
  if (pruning.is_alive[at(n)] == 0) return;
  root_ = cluster_count();
  append(n);
  first_.push_back(size());
}

template <class Visit>
void WalkGraph::for_each_arc(int from, Visit visit) const {
  detail::for_each_arc(instance_, anchor_, original(from), [&](int original_to, double cost) {
    const int to = number_[at(original_to)];
    if (to >= 0) visit(to, cost);
  });
}

/// Distances between points are integers by definition.
void WalkGraph::look_for_fractions() {
  is_integer_ = anchor_.inner_cost == std::floor(anchor_.inner_cost);
  if (instance_.is_complete()) return;
  for (int u = 0; u < size() && is_integer_; ++u) {
    for_each_arc(u, [&](int, double cost) { is_integer_ = is_integer_ && cost == std::floor(cost); });
  }
}

void WalkGraph::list_cheapest(std::span<const double> price, int per_vertex) {
  struct Offer {
    double reduced;
    Arc arc;
  };
  const auto is_less = [](const Offer& a, const Offer& b) {
    return a.reduced != b.reduced ? a.reduced < b.reduced : a.arc.to < b.arc.to;
  };
  const auto is_left_of = [](const Offer& a, const Offer& b) { return a.arc.to < b.arc.to; };
  const std::size_t m = at(cluster_count());
  bool is_complete = true;
  out_.clear();
  beyond_.assign(original_.size() * m, kNoArc);
  std::vector<Offer> offers;
  for (int u = 0; u < size(); ++u) {
    offers.clear();
    for_each_arc(u, [&](int to, double cost) {
      if (cost <= most_cost_) offers.push_back({cost - price[at(cluster_of(to))], {to, cost}});
    });
    if (offers.size() > at(per_vertex)) {
      is_complete = false;
      const auto rest = offers.begin() + per_vertex;
      std::nth_element(offers.begin(), rest, offers.end(), is_less);
      for (auto offer = rest; offer != offers.end(); ++offer) {
        double& least = beyond_[at(u) * m + at(cluster_of(offer->arc.to))];
        least = std::min(least, offer->arc.cost);
      }
      offers.erase(rest, offers.end());
    }
    std::sort(offers.begin(), offers.end(), is_left_of);
    for (const Offer& offer : offers) out_.push_back(offer.arc);
    out_first_[at(u) + 1] = out_.size();
  }
  if (is_complete) beyond_.clear();
  list_in();
}

bool WalkGraph::list_only(const std::function<bool(int, int, double)>& keep, std::size_t limit) {
  std::vector<Arc> kept;
  std::vector<std::size_t> first = {0};
  const bool all_are_listed = !out_.empty() && !has_beyond();
  for (int u = 0; u < size(); ++u) {
    const auto consider = [&](int to, double cost) {
      if (kept.size() <= limit && keep(u, to, cost)) kept.push_back({to, cost});
    };
    if (all_are_listed) {
      for (const Arc& arc : out(u)) consider(arc.to, arc.cost);
    } else {
      for_each_arc(u, consider);
    }
    if (kept.size() > limit) return false;
    first.push_back(kept.size());
  }
  out_ = std::move(kept);
  out_first_ = std::move(first);
  beyond_.clear();
  list_in();
  return true;
}

void WalkGraph::list_also(std::vector<Bundle> bundles) {
  std::sort(bundles.begin(), bundles.end());
  bundles.erase(std::unique(bundles.begin(), bundles.end()), bundles.end());
  const std::size_t m = at(cluster_count());
  std::vector<Arc> arcs;
  std::vector<std::size_t> first = {0};
  auto bundle = bundles.begin();
  for (int u = 0; u < size(); ++u) {
    std::vector<Arc> row(out(u).begin(), out(u).end());
    for (; bundle != bundles.end() && bundle->from == u; ++bundle) {
      if (beyond_[at(u) * m + at(bundle->cluster)] == kNoArc) continue;
      std::erase_if(row, [&](const Arc& arc) { return cluster_of(arc.to) == bundle->cluster; });
      for (int v = this->first(bundle->cluster); v < last(bundle->cluster); ++v) {
        const double cost = detail::arc_cost(instance_, anchor_, original(u), original(v));
        if (cost <= most_cost_ && cost != kNoArc) row.push_back({v, cost});
      }
      beyond_[at(u) * m + at(bundle->cluster)] = kNoArc;
    }
    arcs.insert(arcs.end(), row.begin(), row.end());
    first.push_back(arcs.size());
  }
  out_ = std::move(arcs);
  out_first_ = std::move(first);
  list_in();
}

void WalkGraph::list_in() {
  in_first_.assign(original_.size() + 1, 0);
  for (const Arc& arc : out_) ++in_first_[at(arc.to) + 1];
  for (std::size_t v = 0; v < original_.size(); ++v) in_first_[v + 1] += in_first_[v];
  std::vector<std::size_t> next(in_first_.begin(), in_first_.end() - 1);
  in_.resize(out_.size());
  for (int u = 0; u < size(); ++u) {
    for (const Arc& arc : out(u)) in_[next[at(arc.to)]++] = {u, arc.cost};
  }
}

std::vector<double> WalkGraph::least_listed() const {
  const std::size_t m = at(cluster_count());
  std::vector<double> least(m * m, kNoArc);
  for (int u = 0; u < size(); ++u) {
    for (const Arc& arc : out(u)) {
      double& cost = least[at(cluster_of(u)) * m + at(cluster_of(arc.to))];
      cost = std::min(cost, arc.cost);
    }
  }
  return least;
}

}  // namespace swallowtail::gtsp::proof
