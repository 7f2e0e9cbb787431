#include "coverage/energy/charging.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::coverage {
namespace {

/// Share of the constant rate.
double share_at(const ChargingCurve& curve, double energy) {
  const double begin = curve.taper_from * curve.full;
  if (curve.is_linear() || energy <= begin) return 1.0;
  const double way = std::min(1.0, (energy - begin) / (curve.full - begin));
  return 1.0 - way * (1.0 - curve.taper_end_rate);
}

}  // namespace

double ChargingCurve::rate(double energy) const {
  return s_per_unit > 0.0 ? share_at(*this, energy) / s_per_unit : 0.0;
}

double ChargingCurve::seconds(double from, double to) const {
  if (!(to > from)) return 0.0;
  const double begin = taper_from * full;
  if (is_linear() || to <= begin) return (to - from) * s_per_unit;
  double time = std::max(0.0, begin - from) * s_per_unit;
  const double low = std::max(from, begin);
  const double high = std::min(to, full);
  if (high > low) {
    // dt = r · de / share(e), the share falling by `slope` per unit.
    const double slope = (1.0 - taper_end_rate) / (full - begin);
    const double share = share_at(*this, low);
    time += slope > 0.0 ? s_per_unit / slope * -std::log1p(-slope * (high - low) / share)
                        : s_per_unit * (high - low);
  }
  if (to > full) time += (to - std::max(from, full)) * s_per_unit / taper_end_rate;
  return time;
}

double ChargingCurve::energy_after(double from, double seconds) const {
  if (from >= full || !(seconds > 0.0)) return from;
  if (s_per_unit <= 0.0) return full;
  const double begin = taper_from * full;
  if (is_linear()) return std::min(full, from + seconds / s_per_unit);
  const double constant_s = std::max(0.0, begin - from) * s_per_unit;
  if (seconds <= constant_s) return from + seconds / s_per_unit;
  const double low = std::max(from, begin);
  const double slope = (1.0 - taper_end_rate) / (full - begin);
  const double rest = (seconds - constant_s) / s_per_unit;
  if (slope <= 0.0) return std::min(full, low + rest);
  return std::min(full, low - share_at(*this, low) / slope * std::expm1(-slope * rest));
}

}  // namespace swallowtail::coverage
