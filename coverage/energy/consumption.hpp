#pragma once

#include <Eigen/Core>

#include "coverage/energy/flight.hpp"

namespace swallowtail::coverage {

/// Learns in flight what flying takes in truth against an energy model. Per unit that the model says, level
/// flight takes all + along · heading (the wind, to first order, whatever the law of the vehicle's drag), and
/// climbing, descending and hovering take all + upright. A Kalman filter over these four: the noise of a
/// stretch grows with its length, as that of gusts and of a slow wander does, and what was learnt long ago
/// counts less.
class Consumption {
 public:
  Consumption();

  /// Flight at a velocity over ground, with what the model says about it without any correction. A negative
  /// duration takes back what was said too early.
  void fly(const EnergyModel& model, const Vec3& velocity_mps, double altitude_m, double duration_s);
  /// The flight noted since the last call took so much.
  void learn(double energy);
  /// The flight noted is not learnt from.
  void forget();

  /// What the flight noted should take, as far as it is known.
  double expected() const { return noted_.dot(shares_); }
  /// What is known, taken cautiously: never less than the model says in still air, and upright flight takes
  /// some of what is taken against the wind, even if it was too short to tell.
  Correction correction() const;
  /// Standard deviation of what a flight that is not level takes, which should take this.
  double upright_deviation(const FlightCost& flight) const;
  /// Of what any flight takes which should take this, if all that is known were true: gusts, as restless as
  /// they have been.
  double gust_deviation(const FlightCost& flight) const;

 private:
  Eigen::Vector4d shares_;  ///< all, along east and north, upright
  Eigen::Matrix4d covariance_;
  Eigen::Vector4d noted_ = Eigen::Vector4d::Zero();  ///< the model's energy by share
  double noise_ = 0.0;                               ///< variance of what the flight noted took
  double surprise_;                                  ///< mean square of what was not foreseen, against noise_
  double noted_s_ = 0.0;
};

}  // namespace swallowtail::coverage
