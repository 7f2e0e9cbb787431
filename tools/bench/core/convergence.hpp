#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace swallowtail::bench {

/// The best value so far and what it took; values only fall along a curve.
struct CurvePoint {
  double cpu_ms = 0.0;
  std::uint64_t evaluations = 0;
  std::uint64_t iterations = 0;
  double value = 0.0;
};
using Curve = std::vector<CurvePoint>;

enum class Effort { kTime_ms, kEvaluations, kIterations };
double effort_of(const CurvePoint& point, Effort effort);

/// Least effort at which the curve is at `target` or below; infinite: never.
double effort_to(const Curve& curve, Effort effort, double target);
/// Value after so much effort; infinite before the first point.
double value_after(const Curve& curve, Effort effort, double spent);

/// Value that lies `gap` (0.01: one percent) above the best known one.
inline double target_of(double best_known, double gap) { return best_known * (1.0 + gap); }

/// Quartiles of many curves at common efforts, for a plot. Efforts where a quarter of the curves has no value
/// yet are left out of `lower`, and so on: such entries are infinite.
struct Band {
  std::vector<double> effort;
  std::vector<double> lower;
  std::vector<double> median;
  std::vector<double> upper;
};
/// At `points` efforts between the least and the greatest that occur, evenly spaced in their logarithm (from
/// the least that is positive).
Band band_of(const std::vector<Curve>& curves, Effort effort, std::size_t points);

}  // namespace swallowtail::bench
