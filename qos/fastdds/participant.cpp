#include "qos/fastdds/participant.hpp"

#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <string_view>

#include "qos/profiles/fastdds.xml.hpp"

namespace swallowtail::fast {

namespace {

namespace dds = eprosima::fastdds::dds;

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? std::string_view(value) : std::string_view();
}

/// Once per process: the vendor adds, but does not replace, profiles.
bool load_embedded_profiles() {
  static const bool loaded = [] {
    auto* factory = dds::DomainParticipantFactory::get_instance();
    return factory->load_XML_profiles_string(kFastProfiles, sizeof kFastProfiles - 1) ==
           ReturnCode_t::RETCODE_OK;
  }();
  return loaded;
}

Result<dds::DomainParticipantQos> participant_qos() {
  auto* factory = dds::DomainParticipantFactory::get_instance();
  if (!environment("FASTRTPS_DEFAULT_PROFILES_FILE").empty()) {
    factory->load_profiles();
    return factory->get_default_participant_qos();
  }
  const std::string_view transport = environment("SWALLOWTAIL_TRANSPORT");
  if (!transport.empty() && transport != "udp" && transport != "shm") {
    return bad_input("SWALLOWTAIL_TRANSPORT is '" + std::string(transport) + "', but must be udp or shm.");
  }
  dds::DomainParticipantQos qos;
  if (!load_embedded_profiles() ||
      factory->get_participant_qos_from_profile(transport == "shm" ? "swallowtail_shm" : "swallowtail",
                                                qos) != ReturnCode_t::RETCODE_OK) {
    return internal_error("Fast DDS does not read the compiled-in profiles (qos/profiles/fastdds.xml).");
  }
  return qos;
}

/// Peers look for participants at the first maxInitialPeersRange ports of a domain. The vendor derives the
/// port from a number that grows with every participant a process ever made; started at the first port, it
/// moves on to the first free one.
void start_at_first_port(dds::DomainParticipantQos& qos, std::uint32_t domain) {
  auto& protocol = qos.wire_protocol();
  for (auto& locator : protocol.builtin.metatrafficUnicastLocatorList) {
    if (locator.kind == LOCATOR_KIND_UDPv4) locator.port = protocol.port.getUnicastPort(domain, 0);
  }
}

}  // namespace

Result<std::unique_ptr<Participant>> Participant::create(const BusOptions& options) {
  if (options.domain > kMaxDomain) {
    return bad_input("The domain is " + std::to_string(options.domain) + ", but must be at most " +
                     std::to_string(kMaxDomain) + ".");
  }
  auto qos = participant_qos();
  if (!qos) return qos.error();
  qos->name(options.participant_name);
  start_at_first_port(*qos, options.domain);
  auto* participant = dds::DomainParticipantFactory::get_instance()->create_participant(options.domain, *qos);
  if (!participant) {
    return internal_error("Fast DDS makes no participant in domain " + std::to_string(options.domain) + ".");
  }
  std::unique_ptr<Participant> owner(new Participant(participant));
  if (!owner->publisher_ || !owner->subscriber_)
    return internal_error("Fast DDS makes no publisher or subscriber.");
  return owner;
}

Participant::Participant(dds::DomainParticipant* participant)
    : participant_(participant),
      publisher_(participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT)),
      subscriber_(participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT)) {}

Participant::~Participant() {
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

dds::Topic* Participant::topic(const TopicQos& row, const dds::TypeSupport& type) {
  const std::lock_guard lock(mutex_);
  if (auto* known = dynamic_cast<dds::Topic*>(participant_->lookup_topicdescription(row.name))) return known;
  if (type.register_type(participant_) != ReturnCode_t::RETCODE_OK) return nullptr;
  return participant_->create_topic(row.name, row.type_name, dds::TOPIC_QOS_DEFAULT);
}

}  // namespace swallowtail::fast
