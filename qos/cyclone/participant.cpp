#include "qos/cyclone/participant.hpp"

#include <cstdlib>
#include <map>
#include <mutex>
#include <string>

#include "qos/profiles/cyclone.xml.hpp"

namespace swallowtail::cyclone {

namespace {

/// The process's domain `id`, configured by the compiled-in text; null when the environment configures it.
Result<std::shared_ptr<const Entity>> domain(std::uint32_t id) {
  static std::mutex mutex;
  static std::map<std::uint32_t, std::weak_ptr<const Entity>> domains;
  const char* uri = std::getenv("CYCLONEDDS_URI");
  if (uri && *uri) return std::shared_ptr<const Entity>();
  const std::lock_guard lock(mutex);
  if (std::shared_ptr<const Entity> known = domains[id].lock()) return known;
  auto made = owned(dds_create_domain(id, kCycloneConfiguration), "domain " + std::to_string(id));
  if (!made) return made.error();
  auto shared = std::make_shared<const Entity>(std::move(*made));
  domains[id] = shared;
  return shared;
}

}  // namespace

Result<std::unique_ptr<Participant>> Participant::create(const BusOptions& options) {
  if (options.domain > kMaxDomain) {
    return bad_input("The domain is " + std::to_string(options.domain) + ", but must be at most " +
                     std::to_string(kMaxDomain) + ".");
  }
  auto shared = domain(options.domain);
  if (!shared) return shared.error();
  const Qos qos(dds_create_qos());
  dds_qset_entity_name(qos.get(), options.participant_name.c_str());
  auto participant = owned(dds_create_participant(options.domain, qos.get(), nullptr),
                           "participant in domain " + std::to_string(options.domain));
  if (!participant) return participant.error();
  return std::unique_ptr<Participant>(new Participant(std::move(*shared), std::move(*participant)));
}

}  // namespace swallowtail::cyclone
