#pragma once

#include <Eigen/Core>

namespace swallowtail::swarm {

/// Volume of what the points (objectives × n, minimised) dominate below the reference point (objectives), by
/// sweeping over one objective after the other; exact up to rounding. 1 to 4 objectives; points that are not
/// below the reference in every objective add nothing. O(n log n) for 2, O(n²) for 3, O(n³) with a small
/// constant for 4 objectives.
double hypervolume(const Eigen::Ref<const Eigen::MatrixXd>& objectives, const Eigen::VectorXd& reference);

/// What each point adds to the volume of all: (n), 0 for points that others dominate.
Eigen::VectorXd hypervolume_contributions(const Eigen::Ref<const Eigen::MatrixXd>& objectives,
                                          const Eigen::VectorXd& reference);

}  // namespace swallowtail::swarm
