#pragma once

#include <cstddef>
#include <vector>

#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage::detail {

/// Indices of the vertices that stay corners when the ring is straightened by at most the tolerance
/// [DOUGLAS-PEUCKER], in order: from 0 to the ring's size, which stands for 0 again.
std::vector<std::size_t> corners_of(const Ring& ring, double tolerance_m);

}  // namespace swallowtail::coverage::detail
