#pragma once

#include <cstdint>

#include "qos/cyclone/entity.hpp"
#include "qos/topics.hpp"

namespace swallowtail::cyclone {

/// The table's row as Cyclone DDS wants it.
Qos writer_qos(const TopicQos& row, std::int32_t ownership_strength);
Qos reader_qos(const TopicQos& row);

}  // namespace swallowtail::cyclone
