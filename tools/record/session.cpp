#include "tools/record/session.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "tools/record/contract.hpp"

namespace swallowtail::record {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kLifecycleSchema = R"({
  "type": "object",
  "title": "What became of an instance",
  "properties": {
    "kind": {"type": "string", "enum": ["dispose", "unregister"]},
    "key_hex": {"type": "string", "description": "the key fields, big endian"},
    "key": {"description": "the key field, or a list of them", "type": ["integer", "array"]}
  },
  "required": ["kind", "key_hex", "key"]
})";

std::string key_hex(const InstanceKey& key, int fields) {
  std::string text;
  for (std::size_t i = 0; i < static_cast<std::size_t>(fields); ++i) {
    for (int shift = 28; shift >= 0; shift -= 4) text.push_back("0123456789abcdef"[(key[i] >> shift) & 15u]);
  }
  return text;
}

std::string lifecycle_json(const Event& event, int fields) {
  nlohmann::json json{{"kind", event.kind == EventKind::kDispose ? "dispose" : "unregister"},
                      {"key_hex", key_hex(event.key, fields)}};
  json["key"] =
      fields == 1 ? nlohmann::json(event.key[0])
                  : nlohmann::json(std::vector<std::uint32_t>(event.key.begin(), event.key.begin() + fields));
  return json.dump();
}

mcap::StringMap describe(const TopicQos& topic, Vendor vendor) {
  mcap::StringMap map{
      {"keyed", topic.key_fields > 0 ? "true" : "false"},
      {"key_fields", std::to_string(topic.key_fields)},
      {"reliability", topic.reliability == Reliability::kReliable ? "reliable" : "best_effort"},
      {"durability", topic.durability == Durability::kTransientLocal ? "transient_local" : "volatile"},
      {"ownership", topic.ownership == Ownership::kExclusive ? "exclusive" : "shared"},
      {"deadline_offered_ms", std::to_string(topic.deadline_offered_ms)},
      {"lifespan_ms", std::to_string(topic.lifespan_ms)},
      {"liveliness_lease_ms", std::to_string(topic.lease_ms)}};
  if (vendor != Vendor::kUnknown) map["first_writer_vendor"] = name_of(vendor);
  return map;
}

}  // namespace

std::string_view name_of(Vendor vendor) {
  switch (vendor) {
    case Vendor::kFastDds:
      return "eProsima Fast DDS";
    case Vendor::kCycloneDds:
      return "Eclipse Cyclone DDS";
    case Vendor::kUnknown:
      break;
  }
  return "unknown";
}

Status SessionParams::validate() const {
  if (flush_every < std::chrono::milliseconds(1)) return bad_input("flush_every is not positive.");
  if (queue_bytes == 0 || queue_events == 0) return bad_input("The queue has no room.");
  return file.validate();
}

struct Session::Topic {
  std::optional<std::uint16_t> channel;
  std::optional<std::uint16_t> lifecycle_channel;
  std::uint64_t samples = 0;
  std::uint64_t lifecycle_events = 0;
  std::map<Vendor, std::uint64_t> by_vendor;
  std::atomic<std::uint64_t> dropped{0};
  std::atomic<std::uint64_t> lost{0};
  std::atomic<std::uint64_t> incompatible_qos{0};
};

Result<std::unique_ptr<Session>> Session::start(const std::filesystem::path& path,
                                                std::vector<TopicQos> topics, const SessionParams& params) {
  if (const Status valid = params.validate(); !valid) return valid.error();
  auto writer = mcap::Writer::create(path, params.file);
  if (!writer) return writer.error();
  std::unique_ptr<Session> session(new Session(std::move(*writer), std::move(topics), params));
  session->thread_ = std::thread([raw = session.get()] { raw->run(); });
  return session;
}

Session::Session(mcap::Writer writer, std::vector<TopicQos> topics, const SessionParams& params)
    : topics_(std::move(topics)),
      params_(params),
      writer_(std::move(writer)),
      queue_(params.queue_bytes, params.queue_events) {
  for (std::size_t i = 0; i < topics_.size(); ++i) states_.push_back(std::make_unique<Topic>());
}

Session::~Session() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
}

void Session::record(Event event) {
  Topic& topic = *states_[event.topic];
  if (!queue_.push(std::move(event))) topic.dropped.fetch_add(1, std::memory_order_relaxed);
}

void Session::count_lost(std::size_t topic, std::uint64_t total) {
  states_[topic]->lost.store(total, std::memory_order_relaxed);
}

void Session::count_incompatible(std::size_t topic, std::uint64_t total) {
  states_[topic]->incompatible_qos.store(total, std::memory_order_relaxed);
}

Status Session::failure() const {
  const std::lock_guard lock(failure_mutex_);
  return failure_;
}

void Session::fail(const Status& status) {
  const std::lock_guard lock(failure_mutex_);
  if (failure_.ok()) failure_ = status;
}

void Session::run() {
  std::vector<Event> events;
  auto flush_at = Clock::now() + params_.flush_every;
  bool failed = false;
  while (queue_.take_all(
      events, std::max<std::chrono::nanoseconds>(flush_at - Clock::now(), std::chrono::nanoseconds(0)))) {
    for (const Event& event : events) {
      if (failed) {
        states_[event.topic]->dropped.fetch_add(1, std::memory_order_relaxed);
        continue;
      }
      if (const Status written = write(event); !written) {
        fail(written);
        failed = true;
      }
    }
    if (Clock::now() < flush_at) continue;
    flush_at = Clock::now() + params_.flush_every;
    if (failed) continue;
    if (const Status flushed = writer_.flush(); !flushed) {
      fail(flushed);
      failed = true;
    }
  }
}

Status Session::open_channel(std::size_t index, Vendor vendor) {
  const TopicQos& topic = topics_[index];
  std::uint16_t schema_id = 0;
  if (const std::string_view idl = contract_idl(topic.type_name); !idl.empty()) {
    const auto schema = writer_.add_schema(topic.type_name, "omgidl", std::string(idl));
    if (!schema) return schema.error();
    schema_id = *schema;
  }
  const auto channel = writer_.add_channel(schema_id, topic.name, "cdr", describe(topic, vendor));
  if (!channel) return channel.error();
  states_[index]->channel = *channel;
  return {};
}

Status Session::open_lifecycle_channel(std::size_t index) {
  if (!lifecycle_schema_) {
    const auto schema =
        writer_.add_schema("swallowtail.Lifecycle", "jsonschema", std::string(kLifecycleSchema));
    if (!schema) return schema.error();
    lifecycle_schema_ = *schema;
  }
  const auto channel =
      writer_.add_channel(*lifecycle_schema_, std::string(topics_[index].name) + "#lifecycle", "json",
                          {{"key_fields", std::to_string(topics_[index].key_fields)}});
  if (!channel) return channel.error();
  states_[index]->lifecycle_channel = *channel;
  return {};
}

Status Session::write_lifecycle(const Event& event) {
  Topic& state = *states_[event.topic];
  if (!state.lifecycle_channel) {
    if (const Status opened = open_lifecycle_channel(event.topic); !opened) return opened;
  }
  const std::string json = lifecycle_json(event, topics_[event.topic].key_fields);
  ++state.lifecycle_events;
  return writer_.write({*state.lifecycle_channel, static_cast<std::uint32_t>(state.lifecycle_events),
                        event.log_time_ns, event.publish_time_ns, std::as_bytes(std::span(json))});
}

Status Session::write(const Event& event) {
  recorded_.fetch_add(1, std::memory_order_relaxed);
  if (event.kind != EventKind::kSample) return write_lifecycle(event);
  Topic& state = *states_[event.topic];
  if (!state.channel) {
    if (const Status opened = open_channel(event.topic, event.vendor); !opened) return opened;
  }
  ++state.samples;
  ++state.by_vendor[event.vendor];
  return writer_.write({*state.channel, static_cast<std::uint32_t>(state.samples), event.log_time_ns,
                        event.publish_time_ns, event.payload.bytes()});
}

Status Session::write_counters() {
  mcap::StringMap entries;
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    const Topic& state = *states_[i];
    nlohmann::json json{{"received", state.samples},
                        {"lifecycle_events", state.lifecycle_events},
                        {"dropped", state.dropped.load()},
                        {"lost", state.lost.load()},
                        {"incompatible_qos", state.incompatible_qos.load()}};
    for (const auto& [vendor, count] : state.by_vendor)
      json["by_vendor"][std::string(name_of(vendor))] = count;
    entries[topics_[i].name] = json.dump();
  }
  return writer_.write_metadata({"swallowtail.recorder", std::move(entries)});
}

Result<SessionSummary> Session::finish() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
  if (const Status ok = failure(); !ok) return ok.error();
  if (const Status written = write_counters(); !written) return written.error();
  if (const Status finished = writer_.finish(); !finished) return finished.error();
  SessionSummary summary;
  for (const auto& state : states_) {
    summary.topics.push_back({state->samples, state->lifecycle_events, state->dropped.load(),
                              state->lost.load(), state->incompatible_qos.load()});
  }
  summary.messages = writer_.statistics().messages;
  summary.file_bytes = writer_.file_bytes();
  summary.start_ns = writer_.statistics().start_ns;
  summary.end_ns = writer_.statistics().end_ns;
  summary.queue_most_bytes = queue_.most_bytes();
  return summary;
}

}  // namespace swallowtail::record
