#include "qos/cyclone/qos.hpp"

namespace swallowtail::cyclone {

namespace {

constexpr int kMaxBlocking_ms = 100;

Qos common_qos(const TopicQos& row, int deadline_ms) {
  Qos owner(dds_create_qos());
  dds_qos_t* qos = owner.get();
  dds_qset_reliability(
      qos, row.reliability == Reliability::kReliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
      DDS_MSECS(kMaxBlocking_ms));
  dds_qset_durability(qos, row.durability == Durability::kTransientLocal ? DDS_DURABILITY_TRANSIENT_LOCAL
                                                                         : DDS_DURABILITY_VOLATILE);
  dds_qset_ownership(qos,
                     row.ownership == Ownership::kExclusive ? DDS_OWNERSHIP_EXCLUSIVE : DDS_OWNERSHIP_SHARED);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, row.history_depth);
  if (deadline_ms > 0) dds_qset_deadline(qos, DDS_MSECS(deadline_ms));
  if (row.lifespan_ms > 0) dds_qset_lifespan(qos, DDS_MSECS(row.lifespan_ms));
  if (row.lease_ms > 0) dds_qset_liveliness(qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_MSECS(row.lease_ms));
  return owner;
}

}  // namespace

Qos writer_qos(const TopicQos& row, std::int32_t ownership_strength) {
  Qos qos = common_qos(row, row.deadline_offered_ms);
  if (row.ownership == Ownership::kExclusive) dds_qset_ownership_strength(qos.get(), ownership_strength);
  // A writer that leaves has not removed what it wrote about; and the dispose sent on its behalf would name a
  // wrong instance to Fast DDS readers.
  dds_qset_writer_data_lifecycle(qos.get(), false);
  if (row.durability == Durability::kTransientLocal) {
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, row.history_depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  return qos;
}

Qos reader_qos(const TopicQos& row) {
  Qos qos = common_qos(row, row.deadline_requested_ms);
  dds_qset_resource_limits(qos.get(), row.max_samples(), row.max_instances, row.history_depth);
  return qos;
}

}  // namespace swallowtail::cyclone
