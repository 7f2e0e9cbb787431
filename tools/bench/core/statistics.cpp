#include "tools/bench/core/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace swallowtail::bench {
namespace {

double between(double low, double high, double share) {
  if (low == high || share == 0.0) return low;
  return std::isinf(high) ? high : low + share * (high - low);
}

struct Ranked {
  double rank_sum_a = 0.0;
  double tie_term = 0.0;  ///< Σ (t³ − t) over groups of t equal values
};

Ranked rank(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<std::pair<double, bool>> all;
  for (const double v : a) all.emplace_back(v, true);
  for (const double v : b) all.emplace_back(v, false);
  std::ranges::sort(all);
  Ranked out;
  for (std::size_t first = 0; first < all.size();) {
    std::size_t last = first;
    while (last < all.size() && all[last].first == all[first].first) ++last;
    const auto ties = static_cast<double>(last - first);
    const double shared_rank = static_cast<double>(first) + 0.5 * (ties + 1.0);
    for (std::size_t i = first; i < last; ++i) out.rank_sum_a += all[i].second ? shared_rank : 0.0;
    out.tie_term += ties * ties * ties - ties;
    first = last;
  }
  return out;
}

/// 2 Σ (−1)^(k−1) exp(−2 k² λ²)
double kolmogorov_tail(double lambda) {
  if (lambda < 0.2) return 1.0;
  double sum = 0.0;
  for (int k = 1; k <= 100; ++k) {
    const double term = std::exp(-2.0 * k * k * lambda * lambda);
    sum += k % 2 == 1 ? term : -term;
    if (term < 1e-16) break;
  }
  return std::clamp(2.0 * sum, 0.0, 1.0);
}

}  // namespace

double quantile(const std::vector<double>& sorted, double q) {
  const double at = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(at));
  if (below + 1 >= sorted.size()) return sorted.back();
  return between(sorted[below], sorted[below + 1], at - static_cast<double>(below));
}

Quartiles quartiles_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  return {values.front(),         quantile(values, 0.25), quantile(values, 0.5),
          quantile(values, 0.75), values.back(),          values.size()};
}

double median_of(std::vector<double> values) { return quartiles_of(std::move(values)).median; }

Interval bootstrap_median(const std::vector<double>& values, double confidence, std::size_t resamples,
                          Rng& rng) {
  if (values.empty()) return {};
  std::vector<double> medians(resamples);
  std::vector<double> drawn(values.size());
  for (double& median : medians) {
    for (double& v : drawn) v = values[rng.below(values.size())];
    std::ranges::sort(drawn);
    median = quantile(drawn, 0.5);
  }
  std::ranges::sort(medians);
  const double tail = 0.5 * (1.0 - confidence);
  return {quantile(medians, tail), quantile(medians, 1.0 - tail)};
}

RankTest mann_whitney(const std::vector<double>& a, const std::vector<double>& b) {
  const auto na = static_cast<double>(a.size());
  const auto nb = static_cast<double>(b.size());
  if (a.empty() || b.empty()) return {};
  const Ranked ranked = rank(a, b);
  const double u = ranked.rank_sum_a - 0.5 * na * (na + 1.0);
  const double n = na + nb;
  const double variance = na * nb / 12.0 * (n + 1.0 - ranked.tie_term / (n * (n - 1.0)));
  if (variance <= 0.0) return {u, 1.0};
  const double distance = std::max(0.0, std::abs(u - 0.5 * na * nb) - 0.5);
  return {u, std::erfc(distance / std::sqrt(variance) / std::numbers::sqrt2)};
}

double share_smaller(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || b.empty()) return 0.5;
  const double pairs = static_cast<double>(a.size()) * static_cast<double>(b.size());
  return 1.0 - mann_whitney(a, b).statistic / pairs;
}

RankTest kolmogorov_smirnov(std::vector<double> a, std::vector<double> b) {
  if (a.empty() || b.empty()) return {};
  std::ranges::sort(a);
  std::ranges::sort(b);
  const auto na = static_cast<double>(a.size());
  const auto nb = static_cast<double>(b.size());
  double difference = 0.0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double x = std::min(a[i], b[j]);
    while (i < a.size() && a[i] == x) ++i;
    while (j < b.size() && b[j] == x) ++j;
    difference = std::max(difference, std::abs(static_cast<double>(i) / na - static_cast<double>(j) / nb));
  }
  const double size = std::sqrt(na * nb / (na + nb));
  return {difference, kolmogorov_tail((size + 0.12 + 0.11 / size) * difference)};
}

std::vector<double> holm(const std::vector<double>& p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double least = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double raised = p_values[order[i]] * static_cast<double>(order.size() - i);
    least = std::max(least, std::min(1.0, raised));
    adjusted[order[i]] = least;
  }
  return adjusted;
}

std::vector<double> rounded(std::vector<double> values, double resolution) {
  for (double& v : values) {
    if (std::isfinite(v)) v = resolution * std::round(v / resolution);
  }
  return values;
}

}  // namespace swallowtail::bench
