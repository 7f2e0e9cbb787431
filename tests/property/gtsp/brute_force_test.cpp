#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "coverage/gtsp/check_tour.hpp"
#include "coverage/gtsp/detail/anchor.hpp"
#include "coverage/gtsp/detail/bound.hpp"
#include "coverage/gtsp/detail/exact.hpp"
#include "coverage/gtsp/detail/run.hpp"
#include "coverage/gtsp/proof/certificate.hpp"
#include "coverage/gtsp/solver.hpp"

namespace swallowtail::gtsp {
namespace {

enum class Form { kSparse, kMatrix, kPoints };

/// A tiny problem as plain data, so that a failure prints what is needed to repeat it.
struct Case {
  Form form = Form::kSparse;
  std::vector<int> cluster_sizes;
  std::vector<ArcInput> arcs;
  std::vector<Point> points;
  bool is_fractional = false;
  bool is_open = false;
  std::vector<int> prefix;
  std::optional<int> start;
  std::optional<int> end;
  std::vector<std::pair<int, int>> precedence;
  std::vector<int> warm_tour;
  bool is_warm = false;
  int seed = 1;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  out << "form " << static_cast<int>(c.form) << (c.is_open ? " open" : " closed") << " sizes";
  for (const int s : c.cluster_sizes) out << ' ' << s;
  out << " prefix";
  for (const int v : c.prefix) out << ' ' << v;
  out << " start " << c.start.value_or(-1) << " end " << c.end.value_or(-1) << " warm";
  for (const int v : c.warm_tour) out << ' ' << v;
  out << " arcs";
  for (const ArcInput& a : c.arcs) out << " {" << a.from << ',' << a.to << ',' << a.cost << '}';
  for (const Point& p : c.points) out << " (" << p.x << ',' << p.y << ')';
  return out << " seed " << c.seed;
}

int vertex_count(const Case& c) {
  int n = 0;
  for (const int size : c.cluster_sizes) n += size;
  return n;
}

Instance::Clusters clusters_of(const Case& c) {
  Instance::Clusters clusters;
  int next = 0;
  for (const int size : c.cluster_sizes) {
    clusters.emplace_back();
    for (int i = 0; i < size; ++i) clusters.back().push_back(next++);
  }
  return clusters;
}

Instance instance_of(const Case& c) {
  const int n = vertex_count(c);
  if (c.form == Form::kPoints) return Instance::from_points(clusters_of(c), c.points, Metric::kEuc2D).value();
  if (c.form == Form::kSparse) return Instance::from_arcs(n, clusters_of(c), c.arcs).value();
  std::vector<double> costs(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), kNoArc);
  for (const ArcInput& a : c.arcs) costs[static_cast<std::size_t>(a.from * n + a.to)] = a.cost;
  return Instance::from_matrix(n, clusters_of(c), costs).value();
}

Options options_of(const Case& c, Mode mode) {
  Options options;
  options.mode = mode;
  options.seed = static_cast<std::uint64_t>(c.seed);
  options.kind = c.is_open ? TourKind::kOpen : TourKind::kClosed;
  options.fixed_prefix = c.prefix;
  options.start_vertex = c.start;
  options.end_vertex = c.end;
  if (c.is_warm) options.warm_tour = c.warm_tour;
  return options;
}

TourRule rule_of(const Case& c) { return {!c.is_open, c.prefix, c.start, c.end, c.precedence}; }

/// Cheapest tour by trying all orders and vertices; kNoArc when there is none.
class BruteForce {
 public:
  BruteForce(const Instance& instance, const Case& c) : instance_(instance), rule_(rule_of(c)) {
    for (int k = 0; k < instance.cluster_count(); ++k) order_.push_back(k);
  }
  double solve() {
    do {
      if (keeps_precedence()) extend(0, 0.0);
    } while (std::next_permutation(order_.begin(), order_.end()));
    return best_;
  }

 private:
  bool keeps_precedence() const {
    const auto place = [&](int k) { return std::find(order_.begin(), order_.end(), k); };
    return std::all_of(rule_.precedence.begin(), rule_.precedence.end(),
                       [&](const auto& pair) { return place(pair.first) < place(pair.second); });
  }
  void extend(std::size_t depth, double cost) {
    if (cost == kNoArc) return;
    if (depth == order_.size()) {
      if (rule_.start && tour_.front() != *rule_.start) return;
      if (rule_.end && tour_.back() != *rule_.end) return;
      const bool returns = rule_.returns_to_start && tour_.size() > 1;
      best_ = std::min(best_, returns ? cost + instance_.cost(tour_.back(), tour_.front()) : cost);
      return;
    }
    for (const int v : instance_.cluster(order_[depth])) {
      if (depth < rule_.prefix.size() && rule_.prefix[depth] != v) continue;
      const double arc = tour_.empty() ? 0.0 : instance_.cost(tour_.back(), v);
      tour_.push_back(v);
      extend(depth + 1, cost + arc);
      tour_.pop_back();
    }
  }

  const Instance& instance_;
  TourRule rule_;
  std::vector<int> order_;
  std::vector<int> tour_;
  double best_ = kNoArc;
};

Case draw_costs(Case c) {
  const int n = vertex_count(c);
  const int density = *rc::gen::element(15, 30, 50, 80, 100);
  c.is_fractional = *rc::gen::arbitrary<bool>();
  const bool is_symmetric = *rc::gen::inRange(0, 3) == 0;
  for (int u = 0; u < n; ++u) {
    c.points.push_back(
        {static_cast<double>(*rc::gen::inRange(0, 50)), static_cast<double>(*rc::gen::inRange(0, 50))});
    for (int v = 0; v < n; ++v) {
      if (u == v || (is_symmetric && v > u) || *rc::gen::inRange(0, 100) >= density) continue;
      const double cost = *rc::gen::inRange(0, 100) / (c.is_fractional ? 7.0 : 1.0);
      c.arcs.push_back({u, v, cost});
      if (is_symmetric) c.arcs.push_back({v, u, cost});
    }
  }
  return c;
}

Case draw_rules(Case c) {
  const auto clusters = clusters_of(c);
  std::vector<int> order;
  for (int k = 0; k < static_cast<int>(clusters.size()); ++k) order.push_back(k);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[*rc::gen::inRange<std::size_t>(0, i)]);
  const auto member = [&](int k) {
    return clusters[static_cast<std::size_t>(k)]
                   [*rc::gen::inRange<std::size_t>(0, clusters[static_cast<std::size_t>(k)].size())];
  };
  c.is_open = *rc::gen::arbitrary<bool>();
  const std::size_t fixed = *rc::gen::element<std::size_t>(0, 0, 0, 1, 2, 3);
  for (std::size_t i = 0; i < std::min(fixed, order.size()); ++i) c.prefix.push_back(member(order[i]));
  if (*rc::gen::arbitrary<bool>()) c.start = c.prefix.empty() ? member(order.front()) : c.prefix.front();
  const std::size_t lead = std::max<std::size_t>(c.prefix.size(), c.start ? 1 : 0);
  if (*rc::gen::inRange(0, 3) == 0 && lead < order.size()) c.end = member(order.back());
  c.is_warm = *rc::gen::arbitrary<bool>();
  const int warm = *rc::gen::inRange(0, 8);
  for (int i = 0; c.is_warm && i < warm; ++i)
    c.warm_tour.push_back(*rc::gen::inRange(-1, vertex_count(c) + 1));
  return c;
}

Case draw_case() {
  Case c;
  c.form = *rc::gen::element(Form::kSparse, Form::kMatrix, Form::kPoints);
  const int clusters = *rc::gen::inRange(1, 7);
  for (int k = 0; k < clusters; ++k) c.cluster_sizes.push_back(*rc::gen::inRange(1, 4));
  c.seed = *rc::gen::inRange(0, 1000);
  return draw_rules(draw_costs(std::move(c)));
}

bool is_near(double a, double b) { return a == b || std::abs(a - b) <= 1e-9 * (1.0 + std::abs(b)); }

RC_GTEST_PROP(Gtsp, SolvesTinyInstancesExactly, ()) {
  const Case c = draw_case();
  RC_LOG() << c << '\n';
  const Instance instance = instance_of(c);
  const double optimum = BruteForce(instance, c).solve();
  const Solution solution = solve(instance, options_of(c, Mode::kFast));
  if (optimum == kNoArc) {
    RC_ASSERT(solution.status == SolveStatus::kInfeasible);
    RC_ASSERT(solution.tour.empty());
    return;
  }
  RC_ASSERT(solution.status == SolveStatus::kOptimal);
  const auto checked = check_tour(instance, solution.tour, rule_of(c));
  RC_ASSERT(checked.ok());
  RC_ASSERT(is_near(checked.value(), solution.cost));
  RC_ASSERT(is_near(solution.cost, optimum));
  RC_ASSERT(solution.lower_bound == solution.cost);
}

/// The search alone, without the exact method behind it: never better than the optimum, never wrong about its
/// tour, and the bound holds.
RC_GTEST_PROP(Gtsp, SearchIsSoundAndBoundIsValid, ()) {
  const Case c = draw_case();
  RC_LOG() << c << '\n';
  const Instance instance = instance_of(c);
  const double optimum = BruteForce(instance, c).solve();
  Options options = options_of(c, Mode::kFast);
  options.stop.max_iterations = 300;
  const detail::Effort search_only{.exact_work = 0.0, .kicks_per_cluster = 100.0, .enough_hits = 2};
  const Solution solution = detail::Run(instance, options, search_only).solve();
  if (solution.status == SolveStatus::kInfeasible) RC_ASSERT(optimum == kNoArc);
  RC_ASSERT(solution.lower_bound <= optimum * (1.0 + 1e-12));
  RC_CLASSIFY(optimum != kNoArc, "feasible");
  RC_CLASSIFY(optimum != kNoArc && solution.tour.empty(), "missed");
  if (solution.tour.empty()) {
    RC_ASSERT(solution.cost == kNoArc);
    return;
  }
  RC_CLASSIFY(is_near(solution.cost, optimum), "optimum found");
  const auto checked = check_tour(instance, solution.tour, rule_of(c));
  if (!checked) RC_LOG() << checked.error().message << '\n';
  RC_ASSERT(checked.ok());
  RC_ASSERT(is_near(checked.value(), solution.cost));
  RC_ASSERT(solution.cost >= optimum || is_near(solution.cost, optimum));
  if (solution.proved_optimal) RC_ASSERT(is_near(solution.cost, optimum));
  if (c.is_warm) {
    if (const auto warm = check_tour(instance, c.warm_tour, rule_of(c)); warm)
      RC_ASSERT(solution.cost <= warm.value());
  }
}

/// Priced walks and the states they leave open, without what else proves tiny instances; with the optimum
/// known, or something above it, or nothing.
RC_GTEST_PROP(Gtsp, CertificatesHold, ()) {
  const Case c = draw_case();
  const double excess = *rc::gen::element(-1.0, 0.0, 1.0, 40.0);
  const double work = *rc::gen::element(300.0, 3e4, 3e6);
  RC_LOG() << c << " excess " << excess << " work " << work << '\n';
  const Instance instance = instance_of(c);
  const double optimum = BruteForce(instance, c).solve();
  const detail::Anchor anchor = detail::make_anchor(instance, options_of(c, Mode::kFast));
  const auto free = std::count(anchor.fixed_cluster.begin(), anchor.fixed_cluster.end(), 0);
  RC_PRE(free + (anchor.is_used ? 1 : 0) >= 2 && free > 0 && anchor.inner_cost != kNoArc);
  const detail::Pruning pruning = detail::prune(instance, anchor);
  RC_PRE(!pruning.has_no_tour());
  proof::CertificateParams params;
  params.work = work;
  if (optimum != kNoArc && excess >= 0.0) params.upper_bound = optimum + excess - anchor.inner_cost;
  const auto certificate = proof::certify(instance, anchor, pruning, params, {});
  RC_CLASSIFY(certificate.kind == proof::Certificate::Kind::kOptimal, "optimal");
  RC_CLASSIFY(certificate.kind == proof::Certificate::Kind::kProved, "proved");
  RC_CLASSIFY(certificate.kind == proof::Certificate::Kind::kNoTour, "no tour");
  const double folded = optimum - anchor.inner_cost;
  switch (certificate.kind) {
    case proof::Certificate::Kind::kNoTour:
      RC_ASSERT(optimum == kNoArc);
      break;
    case proof::Certificate::Kind::kProved:
      RC_ASSERT(is_near(params.upper_bound, folded));
      break;
    case proof::Certificate::Kind::kOptimal: {
      const auto same = [](int v) { return v; };
      const auto found = detail::found_from(instance, anchor, certificate.order, same,
                                            c.is_open ? TourKind::kOpen : TourKind::kClosed);
      const auto checked = check_tour(instance, found.tour, rule_of(c));
      RC_ASSERT(checked.ok());
      RC_ASSERT(is_near(checked.value(), optimum));
      break;
    }
    case proof::Certificate::Kind::kBound:
      RC_ASSERT(certificate.lower_bound <= folded + 1e-9 * (1.0 + std::abs(folded)));
      break;
  }
}

/// Pairs that a random order of the clusters keeps, with what is fixed at its ends.
Case draw_precedence(Case c) {
  const Instance instance = instance_of(c);
  std::vector<int> order;
  const auto append = [&](int k) {
    if (std::find(order.begin(), order.end(), k) == order.end()) order.push_back(k);
  };
  for (const int v : c.prefix) append(instance.cluster_of(v));
  if (c.start) append(instance.cluster_of(*c.start));
  const int last = c.end ? instance.cluster_of(*c.end) : -1;
  const int shift = *rc::gen::inRange(0, instance.cluster_count());
  for (int k = 0; k < instance.cluster_count(); ++k) {
    const int cluster = (k + shift) % instance.cluster_count();
    if (cluster != last) append(cluster);
  }
  if (last >= 0) append(last);
  const auto count = static_cast<int>(order.size());
  for (int i = 0; count > 1 && i < *rc::gen::inRange(1, 4); ++i) {
    const int a = *rc::gen::inRange(0, count - 1);
    const int b = *rc::gen::inRange(a + 1, count);
    c.precedence.emplace_back(order[static_cast<std::size_t>(a)], order[static_cast<std::size_t>(b)]);
  }
  return c;
}

RC_GTEST_PROP(Gtsp, KeepsPrecedence, ()) {
  const Case c = draw_precedence(draw_case());
  RC_LOG() << c << '\n';
  const Instance instance = instance_of(c);
  const double optimum = BruteForce(instance, c).solve();
  Options options = options_of(c, Mode::kFast);
  options.precedence = c.precedence;
  RC_ASSERT(validate(options, instance).ok());
  const Solution solution = solve(instance, options);
  RC_ASSERT(solution.status != SolveStatus::kInfeasible || optimum == kNoArc);
  RC_ASSERT(solution.status == SolveStatus::kOptimal || optimum == kNoArc);
  if (!solution.tour.empty()) {
    const auto checked = check_tour(instance, solution.tour, rule_of(c));
    RC_ASSERT(checked.ok());
    RC_ASSERT(is_near(checked.value(), optimum));
  }
}

/// The same answer from one thread and from two, to the bit.
RC_GTEST_PROP(Gtsp, ThreadsDoNotChangeTheAnswer, ()) {
  const Case c = draw_case();
  RC_LOG() << c << '\n';
  const Instance instance = instance_of(c);
  Options options = options_of(c, Mode::kFast);
  options.stop.max_iterations = 300;
  const detail::Effort search_only{.exact_work = 0.0, .kicks_per_cluster = 100.0, .enough_hits = 2};
  const Solution one = detail::Run(instance, options, search_only).solve();
  options.threads = 2;
  const Solution two = detail::Run(instance, options, search_only).solve();
  RC_ASSERT(one.tour == two.tour);
  RC_ASSERT(one.cost == two.cost);
  RC_ASSERT(one.status == two.status);
}

}  // namespace
}  // namespace swallowtail::gtsp
