#pragma once

#include <cstdint>

#include "planner/base/result.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::cli {

enum class TerrainKind : std::uint8_t {
  kMountains,  ///< a sum of bells [BOA Eq. 7, sign corrected] at random places
  kHills,      ///< gentle waves of many directions, none longer than half the side
  kFarmland,   ///< two level plains and a ramp between them
};

struct TerrainParams {
  TerrainKind kind = TerrainKind::kHills;
  Vec2 size_m = Vec2(800, 600);
  double cell_size_m = 8.0;
  double relief_m = 40.0;  ///< between the lowest and the highest sample
  int count = 8;           ///< of mountains, or of waves
  std::uint64_t seed = 1;
};

/// Made samples for tests and demonstrations, the same for a seed on every machine: south-west sample at (0,
/// 0), lowest sample at 0, rounded to centimetres so that files pack well. Errors (kBadInput): a size, cell
/// size, relief or count that is not positive, more than 4e6 samples.
Result<planner::TerrainGrid> generate_terrain(const TerrainParams& params);

}  // namespace swallowtail::cli
