#pragma once

#include "idl/codec/cyclone/common.hpp"

#include "status.h"

namespace swallowtail::codec::cyclone {

data::Refusal to_data(const swallowtail_ChargerState& wire, data::ChargerState& value);
void to_wire(const data::ChargerState& value, swallowtail_ChargerState& wire);
data::Refusal to_data(const swallowtail_ParticipantStatus& wire, data::ParticipantStatus& value);
void to_wire(const data::ParticipantStatus& value, swallowtail_ParticipantStatus& wire);

template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_ChargerState>() {
  return swallowtail_ChargerState_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_ParticipantStatus>() {
  return swallowtail_ParticipantStatus_desc;
}

}  // namespace swallowtail::codec::cyclone
