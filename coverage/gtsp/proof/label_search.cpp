#include "coverage/gtsp/proof/label_search.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::gtsp::proof {

LabelSearch::LabelSearch(const WalkGraph& graph, NgWalks& walks, const std::vector<double>& price)
    : graph_(graph), walks_(walks), price_(price) {
  double size = 1.0;
  for (const double p : price) {
    price_sum_ += p;
    size += std::abs(p);
  }
  tolerance_ = 1e-10 * size;
}

LabelSearch::Answer LabelSearch::run(double limit, std::size_t max_states, double max_work,
                                     const StopCondition& stop) {
  limit_ = limit;
  max_work_ = max_work;
  best_ = {};
  for (int root = graph_.first(graph_.root()); root < graph_.last(graph_.root()); ++root) {
    best_.end = run_from(root, max_states, stop);
    if (best_.end != End::kSearched) return best_;
  }
  return best_;
}

LabelSearch::End LabelSearch::run_from(int root, std::size_t max_states, const StopCondition& stop) {
  const double least = walks_.backward(price_, root) + price_sum_;
  work_ += walks_.pass_work();
  if (least > limit_ + tolerance_) return End::kSearched;
  labels_.assign(1, Label{});
  labels_.front().vertex = root;
  std::vector<Label> next;
  std::size_t begin = 0;
  for (int layer = 1; layer < graph_.cluster_count(); ++layer) {
    if (stop.reached(0, 0)) return End::kStopped;
    load_completions(layer);
    next.clear();
    const std::size_t end = labels_.size();
    for (std::size_t i = begin; i < end; ++i) {
      if (work_ > max_work_) return End::kTooMany;
      extend(static_cast<int>(i), next);
      if (i % 1024 == 0 && stop.reached(0, 0)) return End::kStopped;
      if (next.size() <= 2 * max_states) continue;
      append(next);
      if (next.size() > max_states) return End::kTooMany;
    }
    append(next);
    begin = end;
    labels_.insert(labels_.end(), next.begin(), next.end());
    if (labels_.size() > max_states) return End::kTooMany;
  }
  close(root, begin);
  return End::kSearched;
}

/// completion_[v][allowed] = least way from v to the root that remembers only clusters in `allowed`.
void LabelSearch::load_completions(int layer) {
  completion_.resize(at(graph_.size()));
  for (int v = 0; v < graph_.size(); ++v) {
    const auto states = walks_.from_states(layer, v);
    auto& least = completion_[at(v)];
    least.assign(states.begin(), states.end());
    for (std::size_t bit = 1; bit < least.size(); bit <<= 1) {
      for (std::size_t mask = 0; mask < least.size(); ++mask) {
        if ((mask & bit) != 0) least[mask] = std::min(least[mask], least[mask ^ bit]);
      }
    }
    work_ += static_cast<double>(least.size());
  }
}

double LabelSearch::completion(int vertex, const Visited& visited) const {
  const auto& memory = walks_.memory()[at(graph_.cluster_of(vertex))];
  std::size_t allowed = 0;
  for (std::size_t i = 1; i < memory.size(); ++i) {
    if (!has(visited, memory[i])) allowed |= std::size_t{1} << (i - 1);
  }
  return completion_[at(vertex)][allowed];
}

void LabelSearch::extend(int index, std::vector<Label>& next) {
  const Label label = labels_[at(index)];
  for (const WalkGraph::Arc& arc : graph_.out(label.vertex)) {
    const int c = graph_.cluster_of(arc.to);
    work_ += 8.0;
    if (c == graph_.root() || has(label.visited, c)) continue;
    Label after{label.cost + arc.cost, label.reduced + arc.cost - price_[at(c)], label.visited, arc.to,
                index};
    after.visited[at(c / 64)] |= std::uint64_t{1} << (static_cast<unsigned>(c) % 64);
    if (after.reduced + completion(arc.to, after.visited) + price_sum_ > limit_ + tolerance_) continue;
    next.push_back(after);
  }
}

/// Keeps the cheapest of the labels with equal vertex and set.
void LabelSearch::append(std::vector<Label>& next) {
  const auto is_before = [](const Label& a, const Label& b) {
    if (a.vertex != b.vertex) return a.vertex < b.vertex;
    if (a.visited != b.visited) return a.visited < b.visited;
    return a.cost != b.cost ? a.cost < b.cost : a.parent < b.parent;
  };
  const auto is_same = [](const Label& a, const Label& b) {
    return a.vertex == b.vertex && a.visited == b.visited;
  };
  work_ += 100.0 * static_cast<double>(next.size());
  std::sort(next.begin(), next.end(), is_before);
  next.erase(std::unique(next.begin(), next.end(), is_same), next.end());
}

void LabelSearch::close(int root, std::size_t begin) {
  for (std::size_t i = begin; i < labels_.size(); ++i) {
    for (const WalkGraph::Arc& arc : graph_.out(labels_[i].vertex)) {
      if (arc.to != root || labels_[i].cost + arc.cost > limit_ || !(labels_[i].cost + arc.cost < best_.cost))
        continue;
      best_.cost = labels_[i].cost + arc.cost;
      best_.tour.clear();
      for (int at_label = static_cast<int>(i); at_label >= 0; at_label = labels_[at(at_label)].parent)
        best_.tour.push_back(labels_[at(at_label)].vertex);
      std::reverse(best_.tour.begin(), best_.tour.end());
      limit_ = best_.cost;
    }
  }
}

}  // namespace swallowtail::gtsp::proof
