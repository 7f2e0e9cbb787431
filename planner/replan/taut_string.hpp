#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/kernels/obstacle_field.hpp"
#include "planner/replan/block_chain.hpp"
#include "planner/replan/nearby_solids.hpp"

namespace swallowtail::planner {

struct TautParams {
  int rounds = 6;            ///< of the multipliers
  int steps_per_round = 6;   ///< of Newton's method
  double first_weight = 60;  ///< of a violation, as a share of the scale, squared
  double growth = 6.0;       ///< of the weight, by round
};

struct TautResult {
  double length_m = 0.0;     ///< as flown within the climb limit
  double violation_m = 0.0;  ///< the deepest
  std::uint64_t evaluations = 0;
  bool given_up = false;  ///< it would come out too long
};

/// Pulls a chain of points taut among obstacles and above ground: finds the shortest path of its corridor.
/// Augmented Lagrangian over the distances of its hops; each round is minimised by Newton's method with exact
/// second derivatives of the hops' lengths and of their distances to spheres (other solids: Gauss–Newton),
/// which are block-tridiagonal, so that a step costs time linear in the number of points
/// [NOCEDAL-WRIGHT Alg. 17.4 and 3.2]. A hop steeper than climb_max_rad has the length it is flown with: the
/// steepest allowed slope and a vertical part. Moving obstacles are met where they are when the current chain
/// passes; that time's own dependence on the chain is left out of the derivatives. Everything is measured in
/// shares of a scale, the distance or three mean hops if that is less, so that a scaled scene gives the
/// scaled chain. Takes memory while chains grow, then no more.
class TautString {
 public:
  /// Borrows the field and its index. `distance_m`: from end to end.
  TautString(const ObstacleField& field, NearbySolids& nearby, const VehicleLimits& limits,
             double distance_m);

  /// `chain` begins and ends with the fixed ends. Given up where it shows after a few rounds that it would
  /// come out longer than `longest_m`.
  TautResult tighten(std::vector<Vec3>& chain, double start_time_s, std::uint64_t max_evaluations,
                     double longest_m, const TautParams& params = {});

  /// Of the chain tightened last: points that bend nothing are left out, and a corner that holds the chain
  /// off something round becomes two where that may save `least_gain_m`. Then it wants to be tightened again.
  /// False if nothing changed.
  bool refine(std::vector<Vec3>& chain, double least_gain_m, std::size_t most_points);

  /// Kept beyond what the field asks for, so that what is left of a violation is none.
  void set_reserve(double factor) { reserve_ = factor; }
  /// Besides, above ground: a rough surface asks for more than its slope under the chain tells.
  void set_ground_factor(double factor) { ground_factor_ = factor; }

 private:
  struct Contact {
    std::size_t hop = 0;
    int solid = 0;  ///< index in the field; −1 − piece: the ground
    double required_m = 0.0;
    double ground_top_m = 0.0;  ///< no ground near the piece is higher
    double multiplier = 0.0;
    double slack = 0.0;     ///< of the last evaluation, share of the scale
    double fraction = 0.0;  ///< the same, along the hop
  };

  void collect(const std::vector<Vec3>& chain);
  void collect_ground(const Vec3& a, const Vec3& b, std::size_t hop, std::size_t& old);
  Contact& add(std::size_t hop, int solid, double required_m, std::size_t& old);
  /// Leaves the derivatives in there_.
  double evaluate(const std::vector<Vec3>& chain);
  double hop_length(const Vec3& d, std::size_t hop);
  double contact(const std::vector<Vec3>& chain, Contact& c);
  bool approach_ground(const Vec3& a, const Vec3& b, const Contact& c, double cap_m,
                       Approach& approach) const;
  void push(const std::vector<Vec3>& chain, const Contact& c, const Approach& approach, double force);
  void add_block(std::size_t a, std::size_t b, const Mat3& block);
  void minimise(std::vector<Vec3>& chain, int steps, std::uint64_t max_evaluations);
  void hold_at_bounds(const std::vector<Vec3>& chain);
  void set_times(const std::vector<Vec3>& chain);
  double required_m(std::size_t solid) const;

  const ObstacleField& field_;
  NearbySolids& nearby_;
  VehicleLimits limits_;
  double distance_m_;
  double scale_m_;
  double near_m_ = 0.0;  ///< obstacles farther from a hop are left out until the next round
  double steepest_;
  double reserve_ = 1.0;
  double ground_factor_ = 1.0;
  double weight_ = 0.0;
  double start_time_s_ = 0.0;
  std::uint64_t evaluations_ = 0;
  std::vector<double> times_s_;
  std::vector<Contact> contacts_;
  std::vector<Contact> before_;
  struct Derivatives {
    std::vector<Vec3> gradient;
    BlockChain hessian;
    void resize(std::size_t points) {
      gradient.resize(points);
      hessian.resize(points - 2);
    }
  };
  Derivatives here_;   ///< of the chain
  Derivatives there_;  ///< of the trial, or being worked out
  std::vector<Vec3> right_;
  std::vector<Vec3> step_;
  std::vector<Vec3> trial_;
  std::vector<Vec3> refined_;
};

/// The length of a straight hop as it is flown within the climb limit.
double flown_length_m(const Vec3& hop, double steepest);
/// The same of a whole chain.
double flown_length_m(const std::vector<Vec3>& chain, double steepest);

}  // namespace swallowtail::planner
