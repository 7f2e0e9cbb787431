#include "qos/fastdds/qos.hpp"

#include <algorithm>

namespace swallowtail::fast {

namespace {

namespace dds = eprosima::fastdds::dds;

constexpr int kHeartbeat_ms = 100;     // else a late Cyclone reader waits 3 s for what is latched
constexpr int kAllocatedAtStart = 16;  // samples; their payloads grow with what is written

eprosima::fastrtps::Duration_t duration(int ms) {
  return {ms / 1000, static_cast<std::uint32_t>(ms % 1000) * 1'000'000u};
}

/// What writers and readers name alike.
template <class Qos>
Qos common_qos(const TopicQos& row, int deadline_ms) {
  Qos qos;
  qos.reliability().kind = row.reliability == Reliability::kReliable ? dds::RELIABLE_RELIABILITY_QOS
                                                                     : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = row.durability == Durability::kTransientLocal ? dds::TRANSIENT_LOCAL_DURABILITY_QOS
                                                                        : dds::VOLATILE_DURABILITY_QOS;
  qos.ownership().kind =
      row.ownership == Ownership::kExclusive ? dds::EXCLUSIVE_OWNERSHIP_QOS : dds::SHARED_OWNERSHIP_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = row.history_depth;
  if (deadline_ms > 0) qos.deadline().period = duration(deadline_ms);
  if (row.lifespan_ms > 0) qos.lifespan().duration = duration(row.lifespan_ms);
  if (row.lease_ms > 0) {
    qos.liveliness().kind = dds::MANUAL_BY_TOPIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = duration(row.lease_ms);
    qos.liveliness().announcement_period = duration(row.lease_ms / 2);
  }
  auto& limits = qos.resource_limits();
  limits.max_instances = row.max_instances;
  limits.max_samples_per_instance = row.history_depth;
  limits.max_samples = row.max_samples();
  limits.allocated_samples = std::min(row.max_samples(), kAllocatedAtStart);
  // The dynamic policies would drop every dispose at a reader.
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  // Data sharing keeps its samples in files under /dev/shm, which a killed process leaves behind.
  qos.data_sharing().off();
  return qos;
}

}  // namespace

dds::DataWriterQos writer_qos(const TopicQos& row, std::int32_t ownership_strength) {
  auto qos = common_qos<dds::DataWriterQos>(row, row.deadline_offered_ms);
  if (row.ownership == Ownership::kExclusive) {
    qos.ownership_strength().value = static_cast<std::uint32_t>(ownership_strength);
  }
  qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
  qos.reliable_writer_qos().times.heartbeatPeriod = duration(kHeartbeat_ms);
  return qos;
}

dds::DataReaderQos reader_qos(const TopicQos& row) {
  return common_qos<dds::DataReaderQos>(row, row.deadline_requested_ms);
}

}  // namespace swallowtail::fast
