#pragma once

#include "idl/codec/fastdds/common.hpp"

#define swallowtail swallowtail_wire
#include "plan.h"
#undef swallowtail

namespace swallowtail::codec::fast {

data::Refusal to_data(const swallowtail_wire::CoveragePlan& wire, data::CoveragePlan& value);
void to_wire(const data::CoveragePlan& value, swallowtail_wire::CoveragePlan& wire);
data::Refusal to_data(const swallowtail_wire::ChargerPlan& wire, data::ChargerPlan& value);
void to_wire(const data::ChargerPlan& value, swallowtail_wire::ChargerPlan& wire);
data::Refusal to_data(const swallowtail_wire::PathPlan& wire, data::PathPlan& value);
void to_wire(const data::PathPlan& value, swallowtail_wire::PathPlan& wire);

}  // namespace swallowtail::codec::fast
