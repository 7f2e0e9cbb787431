#pragma once

#include <array>
#include <tuple>

#include "idl/data/types.hpp"
#include "planner/base/rng.hpp"

/// Valid samples of every topic type, for tests of codecs and buses.
namespace swallowtail::testing {

using AllTypes = std::tuple<data::TerrainTile, data::Obstacle, data::VehicleState, data::BatteryState,
                            data::CoverageTask, data::Goal, data::MissionClock, data::CoveragePlan,
                            data::ChargerPlan, data::PathPlan, data::ChargerState, data::ParticipantStatus>;

/// How large the sample is: sequences and texts empty (or as short as they may be), at random, or at their
/// bounds with numbers at theirs.
enum class Extent { kEmpty, kRandom, kFull };

void fill(data::TerrainTile& sample, Extent extent, Rng& rng);
void fill(data::Obstacle& sample, Extent extent, Rng& rng);
void fill(data::VehicleState& sample, Extent extent, Rng& rng);
void fill(data::BatteryState& sample, Extent extent, Rng& rng);
void fill(data::CoverageTask& sample, Extent extent, Rng& rng);
void fill(data::Goal& sample, Extent extent, Rng& rng);
void fill(data::MissionClock& sample, Extent extent, Rng& rng);
void fill(data::CoveragePlan& sample, Extent extent, Rng& rng);
void fill(data::ChargerPlan& sample, Extent extent, Rng& rng);
void fill(data::PathPlan& sample, Extent extent, Rng& rng);
void fill(data::ChargerState& sample, Extent extent, Rng& rng);
void fill(data::ParticipantStatus& sample, Extent extent, Rng& rng);

template <class T>
T make_sample(Extent extent, std::uint64_t seed) {
  Rng rng(seed);
  T sample;
  fill(sample, extent, rng);
  return sample;
}

/// Calls f(T{}) for each topic type.
template <class F>
void for_each_type(F f) {
  std::apply([&f](auto... sample) { (f(sample), ...); }, AllTypes{});
}

}  // namespace swallowtail::testing
