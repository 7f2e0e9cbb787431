#pragma once

#include "idl/codec/fastdds/common.hpp"

#define swallowtail swallowtail_wire
#include "world.h"
#undef swallowtail

namespace swallowtail::codec::fast {

data::Refusal to_data(const swallowtail_wire::TerrainTile& wire, data::TerrainTile& value);
void to_wire(const data::TerrainTile& value, swallowtail_wire::TerrainTile& wire);
data::Refusal to_data(const swallowtail_wire::Obstacle& wire, data::Obstacle& value);
void to_wire(const data::Obstacle& value, swallowtail_wire::Obstacle& wire);

}  // namespace swallowtail::codec::fast
