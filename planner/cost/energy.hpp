#pragma once

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"
#include "planner/cost/objective.hpp"
#include "planner/path/path.hpp"

namespace swallowtail::planner {

/// Energy units per second in each kind of flight, and the wind. The default is the document's model, one
/// unit per second aloft [COV 3].
struct EnergyModel {
  double level_per_s = 1.0;
  double climb_per_s = 1.0;
  double descent_per_s = 1.0;
  double hover_per_s = 1.0;
  Vec2 wind_mps = Vec2::Zero();  ///< where it blows to
};
/// Errors: a rate that is negative or not finite, wind that is not finite or not below the cruise speed.
Status validate(const EnergyModel& model, const VehicleLimits& limits);

/// Energy to fly the path. A segment takes as long as its level part at the ground speed that cruise speed in
/// the air leaves, or its climb or descent, whichever is longer: the climbing time at the climb rate, the
/// rest at the level rate. A corner beyond turn_max_rad is a stop of kStopToTurn_s at the hover rate. Ground
/// speed with wind w along unit direction u: u·w + sqrt(v² − |w|² + (u·w)²), drift across held against.
class Energy final : public Objective {
 public:
  Energy(const EnergyModel& model, const VehicleLimits& limits) : model_(model), limits_(limits) {}
  const char* name() const override { return "energy"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  double of_segment(double dx, double dy, double dz) const;

  EnergyModel model_;
  VehicleLimits limits_;
};

}  // namespace swallowtail::planner
