#include "coverage/gtsp/detail/pruning.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace swallowtail::gtsp::detail {
namespace {

constexpr double kMostCutWork = 3e7;

/// The folded instance's arcs without their costs, in one direction.
struct Links {
  std::vector<std::size_t> first;
  std::vector<int> target;

  template <class Visit>
  void for_each(int v, Visit visit) const {
    for (std::size_t i = first[static_cast<std::size_t>(v)]; i < first[static_cast<std::size_t>(v) + 1]; ++i)
      visit(target[i]);
  }
};

class Pruner {
 public:
  Pruner(const Instance& instance, const Anchor& anchor) : instance_(instance), anchor_(anchor) {
    const auto n = static_cast<std::size_t>(instance.vertex_count());
    result_.is_alive.assign(n + 1, 0);
    for (int v = 0; v < instance.vertex_count(); ++v)
      result_.is_alive[static_cast<std::size_t>(v)] = is_free(v) ? 1 : 0;
    result_.is_alive[n] = anchor.is_used ? 1 : 0;
    link();
  }

  Pruning run() {
    drop_by_degree();
    while (name_emptied_cluster(), !is_proved() && drop_unreachable()) drop_by_degree();
    if (!is_proved()) name_cutting_cluster();
    return std::move(result_);
  }

 private:
  bool is_free(int v) const {
    return anchor_.fixed_cluster[static_cast<std::size_t>(instance_.cluster_of(v))] == 0;
  }
  bool is_alive(int v) const { return result_.is_alive[static_cast<std::size_t>(v)] != 0; }
  bool is_proved() const { return result_.has_no_tour(); }
  int node_count() const { return instance_.vertex_count() + 1; }

  void link() {
    const auto nodes = static_cast<std::size_t>(node_count());
    forward_.first.assign(nodes + 1, 0);
    backward_.first.assign(nodes + 1, 0);
    const auto for_all = [&](auto visit) {
      for (int u = 0; u < node_count(); ++u) {
        if (is_alive(u)) for_each_arc(instance_, anchor_, u, [&](int v, double) { visit(u, v); });
      }
    };
    for_all([&](int u, int v) {
      ++forward_.first[static_cast<std::size_t>(u) + 1];
      ++backward_.first[static_cast<std::size_t>(v) + 1];
    });
    for (std::size_t v = 0; v < nodes; ++v) {
      forward_.first[v + 1] += forward_.first[v];
      backward_.first[v + 1] += backward_.first[v];
    }
    forward_.target.resize(forward_.first.back());
    backward_.target.resize(backward_.first.back());
    auto next_forward = forward_.first;
    auto next_backward = backward_.first;
    for_all([&](int u, int v) {
      forward_.target[next_forward[static_cast<std::size_t>(u)]++] = v;
      backward_.target[next_backward[static_cast<std::size_t>(v)]++] = u;
    });
  }

  int cluster_of(int v) const {
    return v == instance_.vertex_count() ? instance_.cluster_count() : instance_.cluster_of(v);
  }

  /// The living clusters at the other ends of a vertex's arcs, as far as it matters how many they are.
  struct Ends {
    int one = -1;  ///< −1 = none
    bool has_more = false;
  };
  Ends ends(const Links& links, int v) const {
    Ends ends;
    links.for_each(v, [&](int w) {
      if (!is_alive(w)) return;
      if (ends.one < 0) ends.one = cluster_of(w);
      ends.has_more = ends.has_more || cluster_of(w) != ends.one;
    });
    return ends;
  }

  /// Whether arcs lead there and on, to another cluster than where they come from unless there are only two.
  bool can_be_passed(int v) const {
    const Ends before = ends(backward_, v);
    const Ends after = ends(forward_, v);
    if (before.one < 0 || after.one < 0) return false;
    return before.has_more || after.has_more || before.one != after.one || clusters_to_visit() == 2;
  }

  int clusters_to_visit() const {
    const auto fixed = std::count(anchor_.fixed_cluster.begin(), anchor_.fixed_cluster.end(), 1);
    return instance_.cluster_count() - static_cast<int>(fixed) + (anchor_.is_used ? 1 : 0);
  }

  void drop_by_degree() {
    std::vector<int> suspects;
    for (int v = 0; v < node_count(); ++v) suspects.push_back(v);
    while (!suspects.empty()) {
      const int v = suspects.back();
      suspects.pop_back();
      if (!is_alive(v) || can_be_passed(v)) continue;
      result_.is_alive[static_cast<std::size_t>(v)] = 0;
      const auto suspect = [&](int w) {
        if (is_alive(w)) suspects.push_back(w);
      };
      forward_.for_each(v, suspect);
      backward_.for_each(v, suspect);
    }
    result_.is_anchor_dead = anchor_.is_used && !is_alive(instance_.vertex_count());
  }

  void name_emptied_cluster() {
    for (int c = 0; c < instance_.cluster_count() && result_.emptied_cluster < 0; ++c) {
      if (anchor_.fixed_cluster[static_cast<std::size_t>(c)] != 0) continue;
      bool has_vertex = false;
      for (const int v : instance_.cluster(c)) has_vertex = has_vertex || is_alive(v);
      if (!has_vertex) result_.emptied_cluster = c;
    }
  }

  /// Living vertices of the anchor, or else of the cluster with the fewest.
  std::vector<int> roots() const {
    if (anchor_.is_used) return {instance_.vertex_count()};
    std::vector<int> fewest;
    for (int c = 0; c < instance_.cluster_count(); ++c) {
      std::vector<int> living;
      for (const int v : instance_.cluster(c)) {
        if (is_alive(v)) living.push_back(v);
      }
      if (fewest.empty() || living.size() < fewest.size()) fewest = std::move(living);
    }
    return fewest;
  }

  std::vector<char> reached_from(const std::vector<int>& sources, const Links& links) const {
    std::vector<char> is_reached(static_cast<std::size_t>(node_count()), 0);
    std::vector<int> stack = sources;
    for (const int v : stack) is_reached[static_cast<std::size_t>(v)] = 1;
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      links.for_each(v, [&](int w) {
        if (!is_alive(w) || is_reached[static_cast<std::size_t>(w)] != 0) return;
        is_reached[static_cast<std::size_t>(w)] = 1;
        stack.push_back(w);
      });
    }
    return is_reached;
  }

  bool drop_unreachable() {
    const std::vector<int> sources = roots();
    const auto reached = reached_from(sources, forward_);
    const auto reaching = reached_from(sources, backward_);
    bool dropped = false;
    for (std::size_t v = 0; v < result_.is_alive.size(); ++v) {
      if (result_.is_alive[v] == 0 || (reached[v] != 0 && reaching[v] != 0)) continue;
      result_.is_alive[v] = 0;
      dropped = true;
    }
    return dropped;
  }

  /// A tour without one of its clusters is a path: what is left must hang together.
  void name_cutting_cluster() {
    const double work = static_cast<double>(forward_.target.size()) * instance_.cluster_count();
    if (work > kMostCutWork || clusters_to_visit() < 4) return;
    for (int c = 0; c < instance_.cluster_count() && result_.cutting_cluster < 0; ++c) {
      if (anchor_.fixed_cluster[static_cast<std::size_t>(c)] == 0 && falls_apart_without(c))
        result_.cutting_cluster = c;
    }
  }

  bool falls_apart_without(int cluster) const {
    std::vector<int> parent(static_cast<std::size_t>(instance_.cluster_count()) + 1);
    std::iota(parent.begin(), parent.end(), 0);
    const auto root_of = [&](int c) {
      while (parent[static_cast<std::size_t>(c)] != c) {
        int& up = parent[static_cast<std::size_t>(c)];
        up = parent[static_cast<std::size_t>(up)];
        c = up;
      }
      return c;
    };
    int parts = clusters_to_visit() - 1;
    for (int u = 0; u < node_count() && parts > 1; ++u) {
      if (!is_alive(u) || cluster_of(u) == cluster) continue;
      forward_.for_each(u, [&](int v) {
        if (!is_alive(v) || cluster_of(v) == cluster) return;
        const int from = root_of(cluster_of(u));
        const int to = root_of(cluster_of(v));
        if (from == to) return;
        parent[static_cast<std::size_t>(from)] = to;
        --parts;
      });
    }
    return parts > 1;
  }

  const Instance& instance_;
  const Anchor& anchor_;
  Links forward_;
  Links backward_;
  Pruning result_;
};

}  // namespace

Pruning all_alive(const Instance& instance, const Anchor& anchor) {
  Pruning all;
  for (int v = 0; v < instance.vertex_count(); ++v) {
    all.is_alive.push_back(anchor.fixed_cluster[static_cast<std::size_t>(instance.cluster_of(v))] == 0 ? 1
                                                                                                       : 0);
  }
  all.is_alive.push_back(anchor.is_used ? 1 : 0);
  return all;
}

Pruning prune(const Instance& instance, const Anchor& anchor) { return Pruner(instance, anchor).run(); }

}  // namespace swallowtail::gtsp::detail
