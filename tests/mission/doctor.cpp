#include "tests/mission/doctor.hpp"

#include <map>
#include <stdexcept>

#include "idl/data/validate.hpp"
#include "tests/interop/raw_writer.hpp"
#include "tools/record/mcap/reader.hpp"
#include "tools/record/mcap/writer.hpp"

namespace swallowtail::testing {
namespace {

void require(const Status& status) {
  if (!status) throw std::runtime_error(status.error().message);
}

template <class R>
auto required(R result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

/// False where the bytes are no valid sample (an intruder's): those are copied as they are.
template <class T>
bool decode(std::span<const std::byte> payload, T& sample) {
  typename fast::WireOf<T>::Wire wire;
  auto* bytes = const_cast<char*>(reinterpret_cast<const char*>(payload.data()));
  eprosima::fastcdr::FastBuffer buffer(bytes, payload.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.read_encapsulation();
  wire.deserialize(cdr);
  return !codec::fast::to_data(wire, sample) && !data::validate(sample);
}

class Copy {
 public:
  explicit Copy(const std::string& to) : writer_(required(mcap::Writer::create(to))) {}

  void announce(const mcap::Reader& reader) {
    std::map<std::uint16_t, std::uint16_t> schemas;
    for (const auto& schema : reader.schemas())
      schemas[schema.id] = required(writer_.add_schema(schema.name, schema.encoding, schema.data));
    for (const auto& channel : reader.channels()) {
      const std::uint16_t schema = channel.schema_id == 0 ? 0 : schemas.at(channel.schema_id);
      channels_[channel.id] =
          required(writer_.add_channel(schema, channel.topic, channel.message_encoding, channel.metadata));
    }
    for (const auto& metadata : reader.metadata()) require(writer_.write_metadata(metadata));
  }

  void put(mcap::Message message) {
    message.channel_id = channels_.at(message.channel_id);
    require(writer_.write(message));
  }

  template <class T>
  void put_changed(mcap::Message message, const std::function<bool(T&)>& change) {
    T sample;
    if (!change || !decode(message.data, sample)) return put(message);
    const T before = sample;
    const bool keep = change(sample);
    if (keep && sample == before) return put(message);
    ++changed_;
    if (!keep) return;
    const auto bytes = cdr_of(sample);
    message.data = std::as_bytes(std::span(bytes));
    put(message);
  }

  int finish() {
    require(writer_.finish());
    return changed_;
  }

 private:
  mcap::Writer writer_;
  std::map<std::uint16_t, std::uint16_t> channels_;
  int changed_ = 0;
};

}  // namespace

int copy_changed(const std::string& from, const std::string& to, const Changes& changes) {
  const auto reader = required(mcap::Reader::open(from));
  Copy copy(to);
  copy.announce(reader);
  const auto put = [&](const mcap::Channel& channel, const mcap::Message& message) {
    if (channel.topic == "VehicleState") return copy.put_changed<data::VehicleState>(message, changes.state);
    if (channel.topic == "BatteryState")
      return copy.put_changed<data::BatteryState>(message, changes.battery);
    if (channel.topic == "PathPlan") return copy.put_changed<data::PathPlan>(message, changes.plan);
    copy.put(message);
  };
  required(reader.for_each_message(put));
  return copy.finish();
}

}  // namespace swallowtail::testing
