#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <algorithm>
#include <cstdint>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "qos/fastdds/participant.hpp"
#include "qos/fastdds/qos.hpp"
#include "qos/fastdds/type.hpp"
#include "qos/topics.hpp"

/// What a program that does not keep to the contract may write.
namespace swallowtail::testing {

/// The CDR of a sample, its header included, whatever the sample holds.
template <class T>
std::vector<unsigned char> cdr_of(const T& sample) {
  typename fast::WireOf<T>::Wire wire;
  codec::fast::to_wire(sample, wire);
  std::vector<unsigned char> bytes(std::remove_reference_t<decltype(wire)>::getCdrSerializedSize(wire) + 4);
  eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  wire.serialize(cdr);
  return bytes;
}

/// Bytes on the wire with the handle of the instance they claim to be of.
struct RawSample {
  std::vector<unsigned char> bytes;
  fast::KeyBytes handle{};
};

/// Writes bytes as they are.
class RawType : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit RawType(const TopicQos& row) {
    setName(row.type_name);
    m_typeSize = 256;
    m_isGetKeyDefined = row.key_fields > 0;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const auto& bytes = static_cast<RawSample*>(data)->bytes;
    std::copy(bytes.begin(), bytes.end(), payload->data);
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t*, void*) override { return false; }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<RawSample*>(data)->bytes.size()); };
  }
  void* createData() override { return new RawSample; }
  void deleteData(void* data) override { delete static_cast<RawSample*>(data); }
  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool) override {
    const auto& key = static_cast<RawSample*>(data)->handle;
    for (unsigned i = 0; i < key.size(); ++i) handle->value[i] = key[i];
    return true;
  }
};

/// A writer of a topic that checks nothing, in a participant of its own or in one of the caller's.
template <class T>
class RawWriter {
 public:
  explicit RawWriter(std::uint32_t domain)
      : RawWriter(std::shared_ptr<fast::Participant>(fast::Participant::create({.domain = domain}).value())) {
  }

  explicit RawWriter(std::shared_ptr<fast::Participant> participant) : participant_(std::move(participant)) {
    auto* topic = participant_->topic(TopicOf<T>::qos,
                                      eprosima::fastdds::dds::TypeSupport(new RawType(TopicOf<T>::qos)));
    writer_ = participant_->publisher()->create_datawriter(topic, fast::writer_qos(TopicOf<T>::qos, 10));
  }

  /// Whether the middleware took it.
  bool write(const T& sample) { return write(cdr_of(sample), TopicOf<T>::key(sample)); }
  bool write(std::vector<unsigned char> bytes, const InstanceKey& key) {
    RawSample raw{std::move(bytes), fast::handle_of(key)};
    return writer_->write(&raw);
  }
  /// That the writer knows of.
  int readers() const {
    eprosima::fastdds::dds::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count;
  }

 private:
  std::shared_ptr<fast::Participant> participant_;
  eprosima::fastdds::dds::DataWriter* writer_ = nullptr;
};

}  // namespace swallowtail::testing
