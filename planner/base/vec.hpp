#pragma once

#include <Eigen/Core>

namespace swallowtail {

/// Point or direction in the local east-north-up frame, metres unless a name says otherwise.
using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

}  // namespace swallowtail
