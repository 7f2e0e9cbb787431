#include "coverage/energy/consumption.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::coverage {
namespace {

constexpr double kPriorAll = 0.2;
constexpr double kPriorAlong = 0.2;
constexpr double kPriorUpright = 0.25;
/// Variance of a second's consumption in units of the mean power squared, were it white: gusts of 0.1 that
/// last 5 s and a wander of 0.05 that lasts 30 s.
constexpr double kNoisePerS = 0.25;
/// By which the variance of a share grows in a second.
constexpr double kDriftPerS = 4e-6;
/// Of what is taken more against the wind, that upright flight is taken to need.
constexpr double kUprightOfAlong = 0.6;
constexpr double kMostAlong = 0.8;
/// Of gusts that last for seconds so much is seen as surprise from second to second, against kNoisePerS.
constexpr double kSurpriseOfGusts = 0.08;
constexpr double kSurpriseBefore = 0.02;
constexpr double kSurpriseWeight = 0.04;

}  // namespace

Consumption::Consumption() : shares_(1.0, 0.0, 0.0, 0.0), surprise_(kSurpriseBefore) {
  covariance_ = Eigen::Vector4d(kPriorAll * kPriorAll, kPriorAlong * kPriorAlong, kPriorAlong * kPriorAlong,
                                kPriorUpright * kPriorUpright)
                    .asDiagonal();
}

void Consumption::fly(const EnergyModel& model, const Vec3& velocity_mps, double altitude_m,
                      double duration_s) {
  EnergyModel plain = model;
  plain.correction = {};
  const double power = base_power(plain, velocity_mps) * altitude_factor(plain, altitude_m);
  const double energy = power * duration_s;
  const Vec2 heading = level_heading(velocity_mps);
  noted_ += energy * Eigen::Vector4d(1.0, heading.x(), heading.y(), 1.0 - heading.norm());
  noise_ += kNoisePerS * power * energy;
  noted_s_ += duration_s;
}

void Consumption::learn(double energy) {
  covariance_.diagonal().array() += kDriftPerS * std::max(0.0, noted_s_);
  const Eigen::Vector4d gain = covariance_ * noted_;
  const double variance = noted_.dot(gain) + noise_;
  if (noted_s_ > 0.0 && variance > 1e-12) {
    const double unforeseen = energy - noted_.dot(shares_);
    shares_ += gain * (unforeseen / variance);
    surprise_ += kSurpriseWeight * (std::min(1.0, unforeseen * unforeseen / variance) - surprise_);
    covariance_ -= gain * gain.transpose() / variance;
  }
  forget();
}

void Consumption::forget() {
  noted_.setZero();
  noise_ = 0.0;
  noted_s_ = 0.0;
}

Correction Consumption::correction() const {
  Correction out;
  out.all = std::max(1.0, shares_[0]);
  out.along = shares_.segment<2>(1);
  const double along = out.along.norm();
  if (along > kMostAlong) out.along *= kMostAlong / along;
  out.upright = std::max({0.0, shares_[3] + shares_[0] - out.all, kUprightOfAlong * out.along.norm()});
  return out;
}

double Consumption::gust_deviation(const FlightCost& flight) const {
  if (!(flight.time_s > 0.0)) return 0.0;
  return flight.energy * std::sqrt(kNoisePerS * std::min(1.0, surprise_ / kSurpriseOfGusts) / flight.time_s);
}

double Consumption::upright_deviation(const FlightCost& flight) const {
  if (!(flight.time_s > 0.0)) return 0.0;
  const Eigen::Vector4d upright(1.0, 0.0, 0.0, 1.0);
  const double known = upright.dot(covariance_ * upright);
  return flight.energy * std::sqrt(known + kNoisePerS / flight.time_s);
}

}  // namespace swallowtail::coverage
