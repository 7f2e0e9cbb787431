#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>

#include "qos/fastdds/wire.hpp"
#include "qos/topics.hpp"

namespace swallowtail::fast {

/// What is allocated for a payload before the first sample; PREALLOCATED_WITH_REALLOC grows it. The generated
/// value is the largest sample there can be, for each sample of the history.
inline constexpr std::uint32_t kFirstPayload_bytes = 1024;

using KeyBytes = std::array<std::uint8_t, 16>;

/// The instance handle of a key: its fields big endian, padded with 0.
inline KeyBytes handle_of(const InstanceKey& key) {
  KeyBytes bytes{};
  for (std::size_t i = 0; i < key.size(); ++i) {
    for (std::size_t b = 0; b < 4; ++b) bytes[4 * i + b] = static_cast<std::uint8_t>(key[i] >> (24 - 8 * b));
  }
  return bytes;
}

/// The key in an instance handle. A plain dds_dispose of Cyclone DDS arrives with a handle of its own making,
/// the encapsulation header 00 01 00 00 and the key little endian, which shows in bytes that should be
/// padding.
inline InstanceKey key_of(const KeyBytes& handle, int key_fields) {
  const auto fields = static_cast<std::size_t>(key_fields);
  const std::size_t last = std::min<std::size_t>(fields + 1, 4) * 4;
  const bool has_header = handle[0] == 0 && handle[1] == 1 && handle[2] == 0 && handle[3] == 0;
  const bool is_odd = has_header && std::any_of(handle.begin() + 4 * fields, handle.begin() + last,
                                                [](std::uint8_t byte) { return byte != 0; });
  InstanceKey key{};
  for (std::size_t i = 0; i < fields; ++i) {
    for (std::size_t b = 0; b < 4; ++b) {
      key[i] |= is_odd ? std::uint32_t{handle[4 + 4 * i + b]} << (8 * b)
                       : std::uint32_t{handle[4 * i + b]} << (24 - 8 * b);
    }
  }
  return key;
}

/// The generated type support made safe for use here: small payloads at start, keys without the buffer that
/// writers and readers of a participant would share, no type information (Cyclone DDS 0.10 drops endpoints
/// that announce this vendor's draft of it), and no exception out of malformed bytes.
template <class T>
class Type final : public WireOf<T>::TypeSupport {
 public:
  using Base = typename WireOf<T>::TypeSupport;
  using Wire = typename WireOf<T>::Wire;

  Type() {
    this->m_typeSize = std::min(this->m_typeSize, kFirstPayload_bytes);
    this->auto_fill_type_object(false);
    this->auto_fill_type_information(false);
  }

  /// The vendor gives samples of bounded types the size m_typeSize and no more.
  bool is_bounded() const override { return false; }

  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    try {
      return Base::deserialize(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }

  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool force_md5) override {
    if (force_md5) return Base::getKey(data, handle, true);
    if (!this->m_isGetKeyDefined) return false;
    const KeyBytes bytes = handle_of(key_of_wire(*static_cast<const Wire*>(data)));
    for (unsigned i = 0; i < bytes.size(); ++i) handle->value[i] = bytes[i];
    return true;
  }

 private:
  static InstanceKey key_of_wire(const Wire& wire) {
    if constexpr (requires { wire.map_id(); })
      return {wire.map_id(), wire.row(), wire.col()};
    else if constexpr (requires { wire.obstacle_id(); })
      return {wire.obstacle_id(), 0, 0};
    else if constexpr (std::is_same_v<T, data::CoveragePlan>)
      return {wire.task_id(), wire.vehicle_id(), 0};
    else if constexpr (std::is_same_v<T, data::CoverageTask>)
      return {wire.task_id(), 0, 0};
    else if constexpr (std::is_same_v<T, data::ChargerPlan> || std::is_same_v<T, data::ChargerState>)
      return {wire.charger_id(), 0, 0};
    else if constexpr (requires { wire.participant_id(); })
      return {wire.participant_id(), 0, 0};
    else if constexpr (requires { wire.vehicle_id(); })
      return {wire.vehicle_id(), 0, 0};
    else
      return {};
  }
};

}  // namespace swallowtail::fast
