#pragma once

#include "idl/codec/cyclone/common.hpp"

#include "mission.h"

namespace swallowtail::codec::cyclone {

data::Refusal to_data(const swallowtail_CoverageTask& wire, data::CoverageTask& value);
void to_wire(const data::CoverageTask& value, swallowtail_CoverageTask& wire);
data::Refusal to_data(const swallowtail_Goal& wire, data::Goal& value);
void to_wire(const data::Goal& value, swallowtail_Goal& wire);
data::Refusal to_data(const swallowtail_MissionClock& wire, data::MissionClock& value);
void to_wire(const data::MissionClock& value, swallowtail_MissionClock& wire);

template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_CoverageTask>() {
  return swallowtail_CoverageTask_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_Goal>() {
  return swallowtail_Goal_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_MissionClock>() {
  return swallowtail_MissionClock_desc;
}

}  // namespace swallowtail::codec::cyclone
