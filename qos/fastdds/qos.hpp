#pragma once

#include <cstdint>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "qos/topics.hpp"

namespace swallowtail::fast {

/// The table's row as Fast DDS wants it.
eprosima::fastdds::dds::DataWriterQos writer_qos(const TopicQos& row, std::int32_t ownership_strength);
eprosima::fastdds::dds::DataReaderQos reader_qos(const TopicQos& row);

}  // namespace swallowtail::fast
