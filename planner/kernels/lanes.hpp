#pragma once

#include <Eigen/Core>

namespace swallowtail::planner {

/// Candidates are evaluated this many at a time, one to a lane. No lane's result depends on another's.
inline constexpr int kLanes = 8;

/// One number for each lane.
using Lanes = Eigen::Array<double, kLanes, 1>;

/// One place for each lane, metres.
struct LanePoint {
  Lanes x = Lanes::Zero();
  Lanes y = Lanes::Zero();
  Lanes z = Lanes::Zero();
};

}  // namespace swallowtail::planner
