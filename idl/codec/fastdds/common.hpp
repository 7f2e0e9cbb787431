#pragma once

#include <fastrtps/utils/fixed_size_string.hpp>

#include <cstddef>
#include <string>
#include <vector>

#include "idl/data/types.hpp"
#include "idl/data/validate.hpp"

// Fast DDS's generated types live in namespace swallowtail_wire in this project (see idl/CMakeLists.txt).
#define swallowtail swallowtail_wire
#include "common.h"
#undef swallowtail

/// Wire to data and back, one pair of functions per topic type. `to_data` checks what a cast would hide
/// (enumerators, bounds) and says why it refuses; the caller then runs `data::validate`. `to_wire` takes a
/// sample that passed `data::validate` and reuses the memory of the caller's wire sample. Neither keeps a
/// reference.
namespace swallowtail::codec::fast {

inline constexpr std::string_view kBadEnumerator = "enumerator out of range";
inline constexpr std::string_view kTooLong = "sequence above its bound";

data::Vec3 vec3(const swallowtail_wire::Vector3& wire);
swallowtail_wire::Vector3 vec3(const data::Vec3& value);
data::GeoOrigin geo_origin(const swallowtail_wire::GeoOrigin& wire);
swallowtail_wire::GeoOrigin geo_origin(const data::GeoOrigin& value);
data::VehicleLimits vehicle_limits(const swallowtail_wire::VehicleLimits& wire);
swallowtail_wire::VehicleLimits vehicle_limits(const data::VehicleLimits& value);
data::RobotBattery robot_battery(const swallowtail_wire::RobotBattery& wire);
swallowtail_wire::RobotBattery robot_battery(const data::RobotBattery& value);

template <std::size_t N>
void get_text(const eprosima::fastrtps::fixed_string<N>& wire, std::string& text) {
  text.assign(wire.c_str(), wire.size());
}

template <std::size_t N>
void put_text(const std::string& text, eprosima::fastrtps::fixed_string<N>& wire) {
  wire = text;
}

/// False when the wire value is above `last`.
template <class Wire, class Enum>
bool get_enum(const Wire& wire, Enum last, Enum& value) {
  const auto number = static_cast<std::uint32_t>(wire);
  if (number > static_cast<std::uint32_t>(last)) return false;
  value = static_cast<Enum>(number);
  return true;
}

template <class Enum, class Wire>
void put_enum(Enum value, Wire& wire) {
  wire = static_cast<Wire>(static_cast<std::uint32_t>(value));
}

/// `get(wire element, element)` returns a Refusal.
template <class Wire, class T, class Get>
data::Refusal get_sequence(const std::vector<Wire>& wire, std::size_t bound, std::vector<T>& values,
                           Get get) {
  if (wire.size() > bound) return kTooLong;
  values.resize(wire.size());
  for (std::size_t i = 0; i < wire.size(); ++i) {
    if (const data::Refusal refusal = get(wire[i], values[i])) return refusal;
  }
  return {};
}

template <class T, class Wire, class Put>
void put_sequence(const std::vector<T>& values, std::vector<Wire>& wire, Put put) {
  wire.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) put(values[i], wire[i]);
}

}  // namespace swallowtail::codec::fast
