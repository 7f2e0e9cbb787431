#pragma once

#include "idl/codec/cyclone/common.hpp"

#include "plan.h"

namespace swallowtail::codec::cyclone {

data::Refusal to_data(const swallowtail_CoveragePlan& wire, data::CoveragePlan& value);
void to_wire(const data::CoveragePlan& value, swallowtail_CoveragePlan& wire);
data::Refusal to_data(const swallowtail_ChargerPlan& wire, data::ChargerPlan& value);
void to_wire(const data::ChargerPlan& value, swallowtail_ChargerPlan& wire);
data::Refusal to_data(const swallowtail_PathPlan& wire, data::PathPlan& value);
void to_wire(const data::PathPlan& value, swallowtail_PathPlan& wire);

template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_CoveragePlan>() {
  return swallowtail_CoveragePlan_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_ChargerPlan>() {
  return swallowtail_ChargerPlan_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_PathPlan>() {
  return swallowtail_PathPlan_desc;
}

}  // namespace swallowtail::codec::cyclone
