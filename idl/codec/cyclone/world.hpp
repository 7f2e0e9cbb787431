#pragma once

#include "idl/codec/cyclone/common.hpp"

#include "world.h"

namespace swallowtail::codec::cyclone {

data::Refusal to_data(const swallowtail_TerrainTile& wire, data::TerrainTile& value);
void to_wire(const data::TerrainTile& value, swallowtail_TerrainTile& wire);
data::Refusal to_data(const swallowtail_Obstacle& wire, data::Obstacle& value);
void to_wire(const data::Obstacle& value, swallowtail_Obstacle& wire);

template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_TerrainTile>() {
  return swallowtail_TerrainTile_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_Obstacle>() {
  return swallowtail_Obstacle_desc;
}

}  // namespace swallowtail::codec::cyclone
