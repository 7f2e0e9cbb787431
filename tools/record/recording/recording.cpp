#include "tools/record/recording/recording.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <exception>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "idl/data/validate.hpp"
#include "qos/fastdds/wire.hpp"
#include "qos/topics.hpp"
#include "tools/record/mcap/reader.hpp"

namespace swallowtail::recording {
namespace {

constexpr std::string_view kLifecycleSuffix = "#lifecycle";
constexpr std::size_t kHeaderBytes = 4;

using Take = std::function<data::Refusal(Recording&, const mcap::Message&)>;

/// Fast CDR reads plain CDR only, which is what the contract's final types travel as.
bool is_plain_cdr(std::span<const std::byte> payload) {
  return payload.size() >= kHeaderBytes && payload[0] == std::byte{0} &&
         (payload[1] == std::byte{0} || payload[1] == std::byte{1});
}

template <class T>
data::Refusal decode(std::span<const std::byte> payload, T& value) {
  if (!is_plain_cdr(payload)) return "not plain CDR";
  using Wire = typename fast::WireOf<T>::Wire;
  const auto wire = std::make_unique<Wire>();
  try {
    // Fast CDR wants a writable buffer; it only reads from it here.
    auto* bytes = const_cast<char*>(reinterpret_cast<const char*>(payload.data()));
    eprosima::fastcdr::FastBuffer buffer(bytes, payload.size());
    eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                               eprosima::fastcdr::Cdr::DDS_CDR);
    cdr.read_encapsulation();
    wire->deserialize(cdr);
  } catch (const std::exception&) {
    return "malformed CDR";
  }
  if (const data::Refusal refusal = codec::fast::to_data(*wire, value)) return refusal;
  return data::validate(value);
}

template <class T>
Take take_into(std::vector<Timed<T>> Recording::*list) {
  return [list](Recording& recording, const mcap::Message& message) {
    Timed<T> timed{message.log_time_ns, message.publish_time_ns, {}};
    const data::Refusal refusal = decode(message.data, timed.value);
    if (!refusal) (recording.*list).push_back(std::move(timed));
    return refusal;
  };
}

const std::map<std::string_view, Take>& takes() {
  static const std::map<std::string_view, Take> table{
      {TopicOf<data::TerrainTile>::qos.name, take_into(&Recording::terrain_tiles)},
      {TopicOf<data::Obstacle>::qos.name, take_into(&Recording::obstacles)},
      {TopicOf<data::VehicleState>::qos.name, take_into(&Recording::vehicle_states)},
      {TopicOf<data::BatteryState>::qos.name, take_into(&Recording::battery_states)},
      {TopicOf<data::CoverageTask>::qos.name, take_into(&Recording::coverage_tasks)},
      {TopicOf<data::Goal>::qos.name, take_into(&Recording::goals)},
      {TopicOf<data::MissionClock>::qos.name, take_into(&Recording::mission_clocks)},
      {TopicOf<data::CoveragePlan>::qos.name, take_into(&Recording::coverage_plans)},
      {TopicOf<data::ChargerPlan>::qos.name, take_into(&Recording::charger_plans)},
      {TopicOf<data::PathPlan>::qos.name, take_into(&Recording::path_plans)},
      {TopicOf<data::ChargerState>::qos.name, take_into(&Recording::charger_states)},
      {TopicOf<data::ParticipantStatus>::qos.name, take_into(&Recording::participant_statuses)}};
  return table;
}

data::Refusal take_ending(Recording& recording, const std::string& topic, const mcap::Message& message) {
  const auto* begin = reinterpret_cast<const char*>(message.data.data());
  const auto json = nlohmann::json::parse(begin, begin + message.data.size(), nullptr, false);
  if (!json.is_object() || !json.contains("kind") || !json.contains("key")) return "no lifecycle event";
  Ending ending{topic, {}, json["kind"] == "dispose"};
  const auto keys = json["key"].is_array() ? json["key"] : nlohmann::json::array({json["key"]});
  if (keys.size() > ending.key.size()) return "no lifecycle event";
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (!keys[i].is_number_unsigned() || keys[i].get<std::uint64_t>() > UINT32_MAX)
      return "no lifecycle event";
    ending.key[i] = keys[i].get<std::uint32_t>();
  }
  recording.endings.push_back({message.log_time_ns, message.publish_time_ns, std::move(ending)});
  return {};
}

void take(Recording& recording, const mcap::Channel& channel, const mcap::Message& message) {
  const std::string_view topic = channel.topic;
  data::Refusal refusal;
  if (topic.ends_with(kLifecycleSuffix) && channel.message_encoding == "json") {
    refusal =
        take_ending(recording, std::string(topic.substr(0, topic.size() - kLifecycleSuffix.size())), message);
  } else if (const auto found = takes().find(topic);
             found != takes().end() && channel.message_encoding == "cdr") {
    refusal = found->second(recording, message);
  } else {
    ++recording.unknown[channel.topic];
  }
  if (refusal) ++recording.refused[channel.topic + ": " + std::string(*refusal)];
}

}  // namespace

Result<Recording> load_recording(const std::filesystem::path& path) {
  const auto reader = mcap::Reader::open(path);
  if (!reader) return reader.error();
  Recording recording;
  recording.is_complete = reader->condition() == mcap::Reader::Condition::kComplete;
  recording.problems = reader->problems();
  const auto read = reader->for_each_message(
      [&](const mcap::Channel& channel, const mcap::Message& message) { take(recording, channel, message); });
  if (!read) return read.error();
  return recording;
}

}  // namespace swallowtail::recording
