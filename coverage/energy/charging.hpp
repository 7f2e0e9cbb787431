#pragma once

namespace swallowtail::coverage {

/// How long charging takes: at a constant rate (constant current), then, above a share of the capacity, at
/// one that falls in a straight line over the energy held to a share of it when full (constant voltage: the
/// current decays exponentially in time). Linear charging is the case without a second part.
struct ChargingCurve {
  double s_per_unit = 2.0;      ///< r, at the constant rate [COV Tab. 2]
  double full = 500.0;          ///< the capacity
  double taper_from = 1.0;      ///< share of the capacity where the rate begins to fall; 1: never
  double taper_end_rate = 0.1;  ///< share of the rate that is left when full, above 0

  bool is_linear() const { return taper_from >= 1.0; }
  /// Units per second with so much held, up to the capacity.
  double rate(double energy) const;
  /// Seconds from one energy to a higher one; 0 when it is not higher. Above the capacity the rate stays as
  /// it is when full.
  double seconds(double from, double to) const;
  /// What is held after so long, the capacity at most.
  double energy_after(double from, double seconds) const;
};

}  // namespace swallowtail::coverage
