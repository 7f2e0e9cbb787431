#pragma once

#include <dds/dds.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "common.h"
#include "idl/data/types.hpp"
#include "idl/data/validate.hpp"

/// Wire to data and back, one pair of functions per topic type. `to_data` checks what a cast would hide
/// (enumerators, bounds) and says why it refuses; the caller then runs `data::validate`. `to_wire` takes a
/// sample that passed `data::validate` and reuses the memory of the caller's wire sample, which a `Sample`
/// owns. Neither keeps a reference.
namespace swallowtail::codec::cyclone {

inline constexpr std::string_view kBadEnumerator = "enumerator out of range";
inline constexpr std::string_view kTooLong = "sequence above its bound";

/// What Cyclone DDS knows of the generated C type `Wire`.
template <class Wire>
const dds_topic_descriptor_t& descriptor();

/// Owns a wire sample and the buffers of its sequences, which come from Cyclone's allocator so that it may
/// take into the sample as well.
template <class Wire>
class Sample {
 public:
  Sample() { std::memset(&wire_, 0, sizeof wire_); }
  ~Sample() { dds_sample_free(&wire_, &descriptor<Wire>(), DDS_FREE_CONTENTS); }
  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;

  Wire& operator*() { return wire_; }
  const Wire& operator*() const { return wire_; }
  Wire* get() { return &wire_; }

 private:
  Wire wire_;
};

data::Vec3 vec3(const swallowtail_Vector3& wire);
swallowtail_Vector3 vec3(const data::Vec3& value);
data::GeoOrigin geo_origin(const swallowtail_GeoOrigin& wire);
swallowtail_GeoOrigin geo_origin(const data::GeoOrigin& value);
data::VehicleLimits vehicle_limits(const swallowtail_VehicleLimits& wire);
swallowtail_VehicleLimits vehicle_limits(const data::VehicleLimits& value);
data::RobotBattery robot_battery(const swallowtail_RobotBattery& wire);
swallowtail_RobotBattery robot_battery(const data::RobotBattery& value);

template <std::size_t N>
void get_text(const char (&wire)[N], std::string& text) {
  text.assign(wire, strnlen(wire, N - 1));
}

template <std::size_t N>
void put_text(const std::string& text, char (&wire)[N]) {
  const std::size_t length = text.size() < N ? text.size() : N - 1;
  std::memcpy(wire, text.data(), length);
  wire[length] = '\0';
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
template <class Sequence, class T, class Get>
data::Refusal get_sequence(const Sequence& wire, std::size_t bound, std::vector<T>& values, Get get) {
  if (wire._length > bound) return kTooLong;
  values.resize(wire._length);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (const data::Refusal refusal = get(wire._buffer[i], values[i])) return refusal;
  }
  return {};
}

/// Grows the sequence's own buffer when it must; never shrinks it.
template <class T, class Sequence, class Put>
void put_sequence(const std::vector<T>& values, Sequence& wire, Put put) {
  const auto length = static_cast<std::uint32_t>(values.size());
  if (length > wire._maximum) {
    void* buffer = dds_realloc_zero(wire._buffer, length * sizeof *wire._buffer);
    wire._buffer = static_cast<decltype(wire._buffer)>(buffer);
    wire._maximum = length;
    wire._release = true;
  }
  wire._length = length;
  for (std::size_t i = 0; i < values.size(); ++i) put(values[i], wire._buffer[i]);
}

}  // namespace swallowtail::codec::cyclone
