#include "tools/record/cyclone/receiver.hpp"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <array>
#include <string>
#include <unordered_map>

#include "tools/record/cyclone/raw_type.hpp"

namespace swallowtail::record::cyclone {
namespace {

constexpr std::size_t kTakeAtOnce = 64;

Error cyclone_error(const std::string& what, dds_return_t code) {
  return internal_error("Cyclone DDS cannot " + what + ": " + dds_strretcode(-code) + ".");
}

struct DeleteQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, DeleteQos>;

struct DeleteListener {
  void operator()(dds_listener_t* listener) const { dds_delete_listener(listener); }
};
using Listener = std::unique_ptr<dds_listener_t, DeleteListener>;

/// What the writers offer is what is asked for; nothing is thrown away, nothing expires, no deadline.
Qos reader_qos(const TopicQos& topic) {
  Qos qos(dds_create_qos());
  const bool is_reliable = topic.reliability == Reliability::kReliable;
  dds_qset_reliability(qos.get(), is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(100));
  dds_qset_durability(qos.get(), topic.durability == Durability::kTransientLocal
                                     ? DDS_DURABILITY_TRANSIENT_LOCAL
                                     : DDS_DURABILITY_VOLATILE);
  dds_qset_ownership(
      qos.get(), topic.ownership == Ownership::kExclusive ? DDS_OWNERSHIP_EXCLUSIVE : DDS_OWNERSHIP_SHARED);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
  dds_qset_resource_limits(qos.get(), DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  const std::array<dds_data_representation_id_t, 2> representations{DDS_DATA_REPRESENTATION_XCDR1,
                                                                    DDS_DATA_REPRESENTATION_XCDR2};
  dds_qset_data_representation(qos.get(), representations.size(), representations.data());
  return qos;
}

/// The first two bytes of a GUID name the vendor.
Vendor vendor_of(dds_entity_t reader, dds_instance_handle_t writer) {
  dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader, writer);
  if (endpoint == nullptr) return Vendor::kUnknown;
  const std::uint8_t high = endpoint->key.v[0];
  const std::uint8_t low = endpoint->key.v[1];
  dds_builtintopic_free_endpoint(endpoint);
  if (high == 0x01 && low == 0x0F) return Vendor::kFastDds;
  if (high == 0x01 && low == 0x10) return Vendor::kCycloneDds;
  return Vendor::kUnknown;
}

EventKind ending_of(dds_instance_state_t state) {
  return state == DDS_IST_NOT_ALIVE_DISPOSED ? EventKind::kDispose : EventKind::kUnregister;
}

}  // namespace

struct Receiver::Topic {
  Session* session = nullptr;
  std::size_t index = 0;
  bool is_keyed = false;  ///< without a key there is no instance to end
  dds_entity_t reader = 0;
  std::unordered_map<dds_instance_handle_t, Vendor> vendors;  ///< by writer; used by the listener only

  void take();
  void put(ddsi_serdata* data, const dds_sample_info_t& info, std::uint64_t now_ns);
  Vendor vendor(dds_instance_handle_t writer);
};

Vendor Receiver::Topic::vendor(dds_instance_handle_t writer) {
  const auto known = vendors.find(writer);
  if (known != vendors.end()) return known->second;
  const Vendor found = vendor_of(reader, writer);
  if (found != Vendor::kUnknown) vendors.emplace(writer, found);
  return found;
}

void Receiver::Topic::put(ddsi_serdata* data, const dds_sample_info_t& info, std::uint64_t now_ns) {
  Event event;
  event.topic = index;
  event.vendor = vendor(info.publication_handle);
  event.log_time_ns = now_ns;
  event.publish_time_ns = info.source_timestamp < 0 ? 0 : static_cast<std::uint64_t>(info.source_timestamp);
  event.key = key_of(*data);
  // A valid sample whose instance is gone brought the end along (write-dispose), or the end came right behind
  // it.
  const bool ends =
      is_keyed && info.instance_state != DDS_IST_ALIVE && (!info.valid_data || info.sample_rank == 0);
  Event ending;
  if (ends) {
    ending.topic = index;
    ending.kind = ending_of(info.instance_state);
    ending.vendor = event.vendor;
    ending.log_time_ns = now_ns;
    ending.publish_time_ns = event.publish_time_ns;
    ending.key = event.key;
  }
  if (info.valid_data) {
    event.payload = Payload(payload_of(*data), data,
                            [](void* owner) { ddsi_serdata_unref(static_cast<ddsi_serdata*>(owner)); });
    session->record(std::move(event));
  } else {
    ddsi_serdata_unref(data);
  }
  if (ends) session->record(std::move(ending));
}

void Receiver::Topic::take() {
  std::array<ddsi_serdata*, kTakeAtOnce> data{};
  std::array<dds_sample_info_t, kTakeAtOnce> infos{};
  for (;;) {
    data.fill(nullptr);
    const dds_return_t count = dds_takecdr(reader, data.data(), kTakeAtOnce, infos.data(), DDS_ANY_STATE);
    if (count <= 0) return;
    const auto now_ns = static_cast<std::uint64_t>(dds_time());
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) put(data[i], infos[i], now_ns);
    if (static_cast<std::size_t>(count) < kTakeAtOnce) return;
  }
}

Result<std::unique_ptr<Receiver>> Receiver::open(std::uint32_t domain, Session& session) {
  std::unique_ptr<Receiver> receiver(new Receiver());
  receiver->participant_ = dds_create_participant(domain, nullptr, nullptr);
  if (receiver->participant_ < 0)
    return cyclone_error("join domain " + std::to_string(domain), receiver->participant_);
  for (std::size_t i = 0; i < session.topics().size(); ++i) {
    if (const Status opened = receiver->open_topic(session, i); !opened) return opened.error();
  }
  return receiver;
}

Status Receiver::open_topic(Session& session, std::size_t index) {
  const TopicQos& profile = session.topics()[index];
  const std::string name = profile.name;
  const Qos qos = reader_qos(profile);
  ddsi_sertype* type = make_raw_type(profile);
  const dds_entity_t topic =
      dds_create_topic_sertype(participant_, name.c_str(), &type, qos.get(), nullptr, nullptr);
  if (topic < 0) {
    ddsi_sertype_unref(type);
    return cyclone_error("make topic " + name, topic);
  }
  topics_.push_back(std::make_unique<Topic>());
  Topic& state = *topics_.back();
  state.session = &session;
  state.index = index;
  state.is_keyed = profile.key_fields > 0;
  const Listener listener(dds_create_listener(&state));
  dds_lset_data_available(listener.get(), [](dds_entity_t reader, void* argument) {
    auto& self = *static_cast<Topic*>(argument);
    self.reader = reader;
    self.take();
  });
  const dds_entity_t reader = dds_create_reader(participant_, topic, qos.get(), listener.get());
  if (reader < 0) return cyclone_error("make a reader of " + name, reader);
  state.reader = reader;
  return {};
}

void Receiver::update_counts() {
  for (const auto& topic : topics_) {
    dds_sample_lost_status_t lost{};
    if (dds_get_sample_lost_status(topic->reader, &lost) == DDS_RETCODE_OK)
      topic->session->count_lost(topic->index, lost.total_count);
    dds_requested_incompatible_qos_status_t incompatible{};
    if (dds_get_requested_incompatible_qos_status(topic->reader, &incompatible) == DDS_RETCODE_OK) {
      topic->session->count_incompatible(topic->index, incompatible.total_count);
    }
  }
}

Receiver::~Receiver() {
  if (participant_ > 0) dds_delete(participant_);
}

}  // namespace swallowtail::record::cyclone
