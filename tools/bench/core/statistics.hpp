#pragma once

#include <cstddef>
#include <vector>

#include "planner/base/rng.hpp"

/// Figures of repeated runs. A value may be infinite (never reached); it then sorts last. NaN must not come
/// in. Nothing here assumes a normal distribution.
namespace swallowtail::bench {

struct Quartiles {
  double min = 0.0;
  double lower = 0.0;  ///< first quartile
  double median = 0.0;
  double upper = 0.0;  ///< third quartile
  double max = 0.0;
  std::size_t count = 0;
};

/// The value below which the share `q` (0 … 1) of the values lies, linear between neighbours (Hyndman & Fan's
/// type 7); `values` sorted and not empty.
double quantile(const std::vector<double>& sorted, double q);
/// All 0 for an empty list.
Quartiles quartiles_of(std::vector<double> values);
double median_of(std::vector<double> values);

struct Interval {
  double low = 0.0;
  double high = 0.0;
};
/// Confidence interval of the median by the percentile bootstrap [EFRON-TIBSHIRANI]: `resamples` draws with
/// replacement. Empty list: {0, 0}.
Interval bootstrap_median(const std::vector<double>& values, double confidence, std::size_t resamples,
                          Rng& rng);

struct RankTest {
  double statistic = 0.0;
  double p_value = 1.0;  ///< two-sided
};

/// Mann–Whitney's test of whether one of two samples tends to be greater [MANN-WHITNEY]: U of `a` (ties count
/// a half), p by the normal approximation with corrections for ties and continuity; p = 1 when either is
/// empty or all values are one.
RankTest mann_whitney(const std::vector<double>& a, const std::vector<double>& b);
/// Share of pairs in which the value of `a` is smaller (ties a half): 0.5 means no difference
/// (Vargha & Delaney's A, for what is minimised).
double share_smaller(const std::vector<double>& a, const std::vector<double>& b);

/// Kolmogorov and Smirnov's test of whether two samples have one distribution: greatest difference of the
/// empirical distributions, p by the asymptotic series with Stephens' correction of the sample size
/// [STEPHENS]. With ties p is too great, never too small.
RankTest kolmogorov_smirnov(std::vector<double> a, std::vector<double> b);

/// p values of several tests, each raised so that the chance of any false alarm among them stays what it is
/// for one [HOLM]; in the order given, at most 1.
std::vector<double> holm(const std::vector<double>& p_values);

/// Values rounded to multiples of `resolution` > 0, so that rounding noise does not decide a rank test;
/// infinite ones stay.
std::vector<double> rounded(std::vector<double> values, double resolution);

}  // namespace swallowtail::bench
