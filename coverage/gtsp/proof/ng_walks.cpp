#include "coverage/gtsp/proof/ng_walks.hpp"

#include <algorithm>
#include <utility>

#include "coverage/gtsp/proof/subset_kernel.hpp"

namespace swallowtail::gtsp::proof {

bool NgWalks::rememorise(std::vector<std::vector<int>> memory, double max_bytes) {
  double states = 0.0;
  for (int c = 0; c < graph_.cluster_count(); ++c) {
    states += static_cast<double>(graph_.last(c) - graph_.first(c)) *
              static_cast<double>(1 << (memory[at(c)].size() - 1));
  }
  if (states * (graph_.cluster_count() + 1.0) * static_cast<double>(sizeof(double)) > max_bytes) return false;
  const auto old_memory = std::exchange(memory_, std::move(memory));
  const auto old_first_state = std::exchange(first_state_, {0});
  vertex_of_state_.clear();
  for (int v = 0; v < graph_.size(); ++v) {
    first_state_.push_back(first_state_.back() + at(masks(v)));
    vertex_of_state_.resize(first_state_.back(), v);
  }
  carry_potentials(old_memory, old_first_state);
  const int m = graph_.cluster_count();
  table_.assign(at(m) * at(m), -1);
  tables_.clear();
  first_move_.assign(at(m) * at(m), 0);
  move_count_.assign(at(m) * at(m), 0);
  moves_.clear();
  for (int u = 0; u < graph_.size(); ++u) {
    for (const WalkGraph::Arc& arc : graph_.out(u)) {
      tabulate(graph_.cluster_of(u), graph_.cluster_of(arc.to));
      tabulate(graph_.cluster_of(arc.to), graph_.cluster_of(u));
    }
  }
  return true;
}

/// A state's potential is that of the one with what was remembered before.
void NgWalks::carry_potentials(const std::vector<std::vector<int>>& old_memory,
                               const std::vector<std::size_t>& old_first_state) {
  const std::vector<double> old = std::exchange(potential_, std::vector<double>(state_count(), 0.0));
  if (old.empty()) return;
  for (int v = 0; v < graph_.size(); ++v) {
    const auto& memory = memory_[at(graph_.cluster_of(v))];
    const auto& before = old_memory[at(graph_.cluster_of(v))];
    std::vector<int> old_bit(memory.size(), 0);
    for (std::size_t i = 1; i < memory.size(); ++i) {
      const auto found = std::find(before.begin(), before.end(), memory[i]);
      if (found != before.end()) old_bit[i] = 1 << (found - before.begin() - 1);
    }
    for (int mask = 0; mask < masks(v); ++mask) {
      int old_mask = 0;
      for (std::size_t i = 1; i < memory.size(); ++i) {
        if ((mask >> (i - 1) & 1) != 0) old_mask |= old_bit[i];
      }
      potential_[first_state_[at(v)] + at(mask)] = old[old_first_state[at(v)] + at(old_mask)];
    }
  }
}

void NgWalks::tabulate(int from_cluster, int to_cluster) {
  const std::size_t pair = at(from_cluster) * at(graph_.cluster_count()) + at(to_cluster);
  if (table_[pair] >= 0) return;
  table_[pair] = static_cast<int>(tables_.size());
  first_move_[pair] = static_cast<int>(moves_.size());
  const auto& from = memory_[at(from_cluster)];
  const auto& to = memory_[at(to_cluster)];
  std::vector<int> bit_of(from.size(), 0);
  int forbidden = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] == to_cluster) forbidden = 1 << i;
    for (std::size_t j = 1; j < to.size(); ++j) {
      if (to[j] == from[i]) bit_of[i] = 1 << (j - 1);
    }
  }
  for (int mask = 0; mask < 1 << (from.size() - 1); ++mask) {
    const int remembered = (mask << 1) | 1;
    int kept = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      if ((remembered >> i & 1) != 0) kept |= bit_of[i];
    }
    tables_.push_back((remembered & forbidden) != 0 ? -1 : kept);
    if (tables_.back() >= 0) moves_.push_back({mask, kept});
  }
  move_count_[pair] = static_cast<int>(moves_.size()) - first_move_[pair];
}

double NgWalks::layer_work() const {
  double work = 0.0;
  for (int v = 0; v < graph_.size(); ++v)
    work += static_cast<double>(masks(v)) * (static_cast<double>(graph_.out(v).size()) + 2.0);
  const double pairs = static_cast<double>(graph_.size()) * graph_.cluster_count();
  return graph_.has_beyond() ? work + 0.5 * pairs : work;
}

double NgWalks::least(const Pass& pass, int i, int v) const {
  const auto values = states(pass, i, v);
  return *std::min_element(values.begin(), values.end());
}

void NgWalks::begin(Pass& pass, std::span<const double> price, int layers) {
  price_.assign(price.begin(), price.end());
  pass.last = layers;
  pass.value.assign((at(layers) + 1) * state_count(), kNoArc);
}

double NgWalks::forward(std::span<const double> price) {
  is_closed_ = true;
  begin(ahead_, price, graph_.cluster_count());
  for (int v = graph_.first(graph_.root()); v < graph_.last(graph_.root()); ++v)
    ahead_.value[first_state_[at(v)]] = 0.0;
  for (int i = 1; i <= ahead_.last; ++i) step<true>(ahead_, i);
  return end(ahead_, {});
}

double NgWalks::backward(std::span<const double> price, std::optional<int> root) {
  is_closed_ = true;
  begin(back_, price, graph_.cluster_count());
  for (int v = graph_.first(graph_.root()); v < graph_.last(graph_.root()); ++v) {
    if (!root || v == *root) back_.value[first_state_[at(v)]] = 0.0;
  }
  for (int i = 1; i <= back_.last; ++i) step<false>(back_, i);
  return end(back_, root);
}

std::vector<double> NgWalks::windows(std::span<const double> price, int arcs) {
  is_closed_ = false;
  begin(back_, price, arcs);
  std::copy(potential_.begin(), potential_.end(), back_.value.begin());
  for (int i = 1; i <= arcs; ++i) step<false>(back_, i);
  const double* const value = layer(back_, arcs);
  std::vector<double> least_by_cluster(at(graph_.cluster_count()), kNoArc);
  window_state_.assign(least_by_cluster.size(), -1);
  for (std::size_t s = 0; s < state_count(); ++s) {
    const std::size_t c = at(graph_.cluster_of(vertex_of_state_[s]));
    if (value[s] == kNoArc || value[s] - potential_[s] >= least_by_cluster[c]) continue;
    least_by_cluster[c] = value[s] - potential_[s];
    window_state_[c] = static_cast<int>(s);
  }
  return least_by_cluster;
}

bool NgWalks::forgets_all() const {
  std::vector<std::size_t> known_by(memory_.size(), 0);
  for (const auto& memory : memory_) {
    for (const int c : memory) ++known_by[at(c)];
  }
  return *std::max_element(known_by.begin(), known_by.end()) < memory_.size();
}

/// Less what all gain on average, so that they stay small.
void NgWalks::learn_potentials(double share) {
  const double* const value = layer(back_, back_.last);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t s = 0; s < state_count(); ++s) {
    if (value[s] == kNoArc) continue;
    sum += value[s] - potential_[s];
    ++count;
  }
  const double mean = count > 0 ? sum / static_cast<double>(count) : 0.0;
  for (std::size_t s = 0; s < state_count(); ++s) {
    if (value[s] != kNoArc) potential_[s] += share * (value[s] - potential_[s] - mean);
  }
}

/// Fills layer i from the one before. In closed walks the root cluster is at both ends and nowhere else;
/// getting back to it needs no memory.
template <bool kIsForward>
void NgWalks::step(Pass& pass, int i) {
  const bool closes = is_closed_ && i == pass.last;
  const double* const before = layer(pass, i - 1);
  double* const now = pass.value.data() + at(i) * state_count();
  for (int u = 0; u < graph_.size(); ++u) {
    const int from_cluster = graph_.cluster_of(u);
    const double* const from = before + first_state_[at(u)];
    const int count = masks(u);
    if (std::all_of(from, from + count, [](double x) { return x == kNoArc; })) continue;
    for (const WalkGraph::Arc& arc : kIsForward ? graph_.out(u) : graph_.in(u)) {
      const int to_cluster = graph_.cluster_of(arc.to);
      if (!may_enter(to_cluster, i)) continue;
      const double arc_weight = weight(arc.cost, kIsForward ? to_cluster : from_cluster);
      double* const to = now + first_state_[at(arc.to)];
      if (closes) {
        to[0] = std::min(to[0], *std::min_element(from, from + count) + arc_weight);
        continue;
      }
      for (const Move move : moves(from_cluster, to_cluster))
        to[move.after] = std::min(to[move.after], from[move.before] + arc_weight);
    }
  }
  if (!graph_.has_beyond()) return;
  note_least(pass, i - 1);
  kIsForward ? leap_forward(pass, i) : leap_backward(pass, i);
}

void NgWalks::note_least(const Pass& pass, int i) {
  least_.resize(at(graph_.size()));
  for (int v = 0; v < graph_.size(); ++v) least_[at(v)] = least(pass, i, v);
}

void NgWalks::leap_forward(Pass& pass, int i) {
  const std::size_t m = at(graph_.cluster_count());
  std::vector<double> into(m, kNoArc);
  for (int u = 0; u < graph_.size(); ++u) {
    const double from = least_[at(u)];
    if (from == kNoArc) continue;
    const auto cost = graph_.beyond(u);
    for (std::size_t c = 0; c < m; ++c) into[c] = std::min(into[c], from + (cost[c] - price_[c]));
  }
  double* const now = pass.value.data() + at(i) * state_count();
  for (int v = 0; v < graph_.size(); ++v) {
    double& value = now[first_state_[at(v)]];
    if (may_enter(graph_.cluster_of(v), i)) value = std::min(value, into[at(graph_.cluster_of(v))]);
  }
}

void NgWalks::leap_backward(Pass& pass, int i) {
  const std::size_t m = at(graph_.cluster_count());
  std::vector<double> onward(m, kNoArc);
  for (int v = 0; v < graph_.size(); ++v) {
    double& least_onward = onward[at(graph_.cluster_of(v))];
    least_onward = std::min(least_onward, least_[at(v)]);
  }
  for (std::size_t c = 0; c < m; ++c) onward[c] -= price_[c];
  double* const now = pass.value.data() + at(i) * state_count();
  for (int u = 0; u < graph_.size(); ++u) {
    if (!may_enter(graph_.cluster_of(u), i)) continue;
    double& value = now[first_state_[at(u)]];
    value = std::min(value, least_sum(onward.data(), graph_.beyond(u).data(), static_cast<int>(m)));
  }
}

double NgWalks::end(const Pass& pass, std::optional<int> root) const {
  double value = kNoArc;
  for (int v = graph_.first(graph_.root()); v < graph_.last(graph_.root()); ++v) {
    if (!root || v == *root) value = std::min(value, layer(pass, pass.last)[first_state_[at(v)]]);
  }
  return value;
}

/// The state one layer before that the state's value came from.
NgWalks::Origin NgWalks::forward_origin(int i, int state) const {
  const int v = vertex_of_state_[at(state)];
  const int cluster = graph_.cluster_of(v);
  const int mask = state - static_cast<int>(first_state_[at(v)]);
  const bool closes = i == ahead_.last;
  const double* const before = layer(ahead_, i - 1);
  const double value = layer(ahead_, i)[state];
  for (const WalkGraph::Arc& arc : graph_.in(v)) {
    const int* const next = table(graph_.cluster_of(arc.to), cluster);
    const auto first = static_cast<int>(first_state_[at(arc.to)]);
    for (int m = 0; m < masks(arc.to); ++m) {
      if ((closes ? 0 : next[m]) == mask && before[first + m] + weight(arc.cost, cluster) == value)
        return {first + m, false};
    }
  }
  int leaper = 0;
  double least_leap = kNoArc;
  for (int s = 0; graph_.has_beyond() && s < static_cast<int>(state_count()); ++s) {
    const double sum = before[s] + weight(graph_.beyond(vertex_of_state_[at(s)])[at(cluster)], cluster);
    if (sum >= least_leap) continue;
    least_leap = sum;
    leaper = s;
  }
  return {leaper, true};
}

/// The state one layer before, which is one arc on, that the state's value came from.
NgWalks::Origin NgWalks::backward_origin(int i, int state) const {
  const int u = vertex_of_state_[at(state)];
  const int cluster = graph_.cluster_of(u);
  const int mask = state - static_cast<int>(first_state_[at(u)]);
  const double* const before = layer(back_, i - 1);
  const double value = layer(back_, i)[state];
  for (const WalkGraph::Arc& arc : graph_.out(u)) {
    const int* const next = table(graph_.cluster_of(arc.to), cluster);
    const auto first = static_cast<int>(first_state_[at(arc.to)]);
    const double arc_weight = weight(arc.cost, graph_.cluster_of(arc.to));
    for (int m = 0; m < masks(arc.to); ++m) {
      if (next[m] == mask && before[first + m] + arc_weight == value) return {first + m, false};
    }
  }
  int landing = 0;
  double least_leap = kNoArc;
  for (int s = 0; graph_.has_beyond() && s < static_cast<int>(state_count()); ++s) {
    const int c = graph_.cluster_of(vertex_of_state_[at(s)]);
    const double sum = before[s] + weight(graph_.beyond(u)[at(c)], c);
    if (sum >= least_leap) continue;
    least_leap = sum;
    landing = s;
  }
  return {landing, true};
}

NgWalks::Walk NgWalks::least_walk() const {
  Walk walk;
  int state = -1;
  const double best = end(ahead_, {});
  for (int v = graph_.first(graph_.root()); v < graph_.last(graph_.root()); ++v) {
    const auto first = static_cast<int>(first_state_[at(v)]);
    if (state < 0 && layer(ahead_, ahead_.last)[first] == best) state = first;
  }
  walk.vertices.push_back(vertex_of_state_[at(state)]);
  for (int i = ahead_.last; i > 0; --i) {
    const Origin origin = forward_origin(i, state);
    state = origin.state;
    const int u = vertex_of_state_[at(state)];
    if (origin.is_leap) walk.leaps.push_back({u, graph_.cluster_of(walk.vertices.back())});
    walk.vertices.push_back(u);
  }
  std::reverse(walk.vertices.begin(), walk.vertices.end());
  return walk;
}

NgWalks::Walk NgWalks::window(int c) const {
  Walk walk;
  int state = window_state_[at(c)];
  walk.vertices.push_back(vertex_of_state_[at(state)]);
  for (int i = back_.last; i > 0; --i) {
    const Origin origin = backward_origin(i, state);
    state = origin.state;
    const int v = vertex_of_state_[at(state)];
    if (origin.is_leap) walk.leaps.push_back({walk.vertices.back(), graph_.cluster_of(v)});
    walk.vertices.push_back(v);
  }
  return walk;
}

}  // namespace swallowtail::gtsp::proof
