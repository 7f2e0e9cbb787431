#pragma once

#include "idl/codec/fastdds/common.hpp"

#define swallowtail swallowtail_wire
#include "status.h"
#undef swallowtail

namespace swallowtail::codec::fast {

data::Refusal to_data(const swallowtail_wire::ChargerState& wire, data::ChargerState& value);
void to_wire(const data::ChargerState& value, swallowtail_wire::ChargerState& wire);
data::Refusal to_data(const swallowtail_wire::ParticipantStatus& wire, data::ParticipantStatus& value);
void to_wire(const data::ParticipantStatus& value, swallowtail_wire::ParticipantStatus& wire);

}  // namespace swallowtail::codec::fast
