#pragma once

#include "idl/codec/fastdds/common.hpp"

#define swallowtail swallowtail_wire
#include "mission.h"
#undef swallowtail

namespace swallowtail::codec::fast {

data::Refusal to_data(const swallowtail_wire::CoverageTask& wire, data::CoverageTask& value);
void to_wire(const data::CoverageTask& value, swallowtail_wire::CoverageTask& wire);
data::Refusal to_data(const swallowtail_wire::Goal& wire, data::Goal& value);
void to_wire(const data::Goal& value, swallowtail_wire::Goal& wire);
data::Refusal to_data(const swallowtail_wire::MissionClock& wire, data::MissionClock& value);
void to_wire(const data::MissionClock& value, swallowtail_wire::MissionClock& wire);

}  // namespace swallowtail::codec::fast
