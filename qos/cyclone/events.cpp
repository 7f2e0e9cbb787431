#include "qos/cyclone/publisher.hpp"
#include "qos/cyclone/subscription.hpp"

namespace swallowtail::cyclone {

Listener writer_events(Counters* counters) {
  Listener listener(dds_create_listener(counters));
  dds_lset_offered_deadline_missed(
      listener.get(), [](dds_entity_t, const dds_offered_deadline_missed_status_t status, void* arg) {
        static_cast<Counters*>(arg)->miss_deadlines(static_cast<std::uint64_t>(status.total_count_change));
      });
  dds_lset_offered_incompatible_qos(
      listener.get(), [](dds_entity_t, const dds_offered_incompatible_qos_status_t status, void* arg) {
        static_cast<Counters*>(arg)->meet_incompatible(static_cast<std::uint64_t>(status.total_count_change));
      });
  return listener;
}

Listener reader_events(AnySubscription* subscription) {
  Listener listener(dds_create_listener(subscription));
  dds_lset_data_available(listener.get(), [](dds_entity_t reader, void* arg) {
    static_cast<AnySubscription*>(arg)->drain(reader);
  });
  dds_lset_requested_deadline_missed(
      listener.get(), [](dds_entity_t, const dds_requested_deadline_missed_status_t status, void* arg) {
        static_cast<AnySubscription*>(arg)->counters().miss_deadlines(
            static_cast<std::uint64_t>(status.total_count_change));
      });
  dds_lset_requested_incompatible_qos(
      listener.get(), [](dds_entity_t, const dds_requested_incompatible_qos_status_t status, void* arg) {
        static_cast<AnySubscription*>(arg)->counters().meet_incompatible(
            static_cast<std::uint64_t>(status.total_count_change));
      });
  dds_lset_sample_rejected(listener.get(),
                           [](dds_entity_t, const dds_sample_rejected_status_t status, void* arg) {
                             auto* target = static_cast<AnySubscription*>(arg);
                             target->counters().reject(target->row().name, "above the resource limits",
                                                       static_cast<std::uint64_t>(status.total_count_change));
                           });
  return listener;
}

}  // namespace swallowtail::cyclone
