#include "tools/bench/core/convergence.hpp"

#include <algorithm>
#include <cmath>

#include "tools/bench/core/statistics.hpp"

namespace swallowtail::bench {

double effort_of(const CurvePoint& point, Effort effort) {
  switch (effort) {
    case Effort::kTime_ms:
      return point.cpu_ms;
    case Effort::kEvaluations:
      return static_cast<double>(point.evaluations);
    case Effort::kIterations:
      break;
  }
  return static_cast<double>(point.iterations);
}

double effort_to(const Curve& curve, Effort effort, double target) {
  for (const CurvePoint& point : curve) {
    if (point.value <= target) return effort_of(point, effort);
  }
  return std::numeric_limits<double>::infinity();
}

double value_after(const Curve& curve, Effort effort, double spent) {
  double value = std::numeric_limits<double>::infinity();
  for (const CurvePoint& point : curve) {
    if (effort_of(point, effort) > spent) break;
    value = std::min(value, point.value);
  }
  return value;
}

Band band_of(const std::vector<Curve>& curves, Effort effort, std::size_t points) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const Curve& curve : curves) {
    for (const CurvePoint& point : curve) {
      const double at = effort_of(point, effort);
      if (at > 0.0) least = std::min(least, at);
      most = std::max(most, at);
    }
  }
  Band band;
  if (most <= 0.0) return band;
  for (std::size_t i = 0; i < points; ++i) {
    const double share = points > 1 ? static_cast<double>(i) / static_cast<double>(points - 1) : 1.0;
    const double spent = i + 1 == points ? most : least * std::pow(most / least, share);
    std::vector<double> values;
    for (const Curve& curve : curves) values.push_back(value_after(curve, effort, spent));
    const Quartiles q = quartiles_of(values);
    band.effort.push_back(spent);
    band.lower.push_back(q.lower);
    band.median.push_back(q.median);
    band.upper.push_back(q.upper);
  }
  return band;
}

}  // namespace swallowtail::bench
