#pragma once

#include <optional>
#include <string_view>

#include "idl/data/types.hpp"

namespace swallowtail::data {

/// Why a sample is refused, as counted in ParticipantStatus: a short fixed phrase such as "not finite" or
/// "energy above capacity".
using Refusal = std::optional<std::string_view>;

/// Each checks one sample by itself: finite, in range, bounded, consistent. No allocation, never throws; the
/// phrases are string literals. Ranges that hold everywhere: |x|, |y| ≤ 1e6 m, −1e3 ≤ z ≤ 2e4 m, 0 ≤ time_s ≤
/// 1e7, |speed| ≤ 200 m/s, radii and sizes in (0, 1e4] m.
Refusal validate(const TerrainTile& tile);
Refusal validate(const Obstacle& obstacle);
Refusal validate(const VehicleState& state);
Refusal validate(const BatteryState& state);
Refusal validate(const CoverageTask& task);  // rings and roads within points, ≥ 3 and ≥ 2 points each,
                                             // outline first, no self-intersection of a ring
Refusal validate(const Goal& goal);
Refusal validate(const MissionClock& clock);
Refusal validate(const CoveragePlan& plan);
Refusal validate(const ChargerPlan& plan);
Refusal validate(const PathPlan& plan);
Refusal validate(const ChargerState& state);
Refusal validate(const ParticipantStatus& status);

}  // namespace swallowtail::data
