#pragma once

#include <cstddef>
#include <span>

#include "qos/topics.hpp"
#include "tools/record/event.hpp"

struct ddsi_serdata;
struct ddsi_sertype;

/// A Cyclone DDS type that takes samples as they are: payload bytes with their encapsulation header, nothing
/// decoded but the key. It matches writers of any vendor by type name alone, in either CDR version. Built on
/// Cyclone 0.10.2's sertype interface, the one its language bindings use.
namespace swallowtail::record::cyclone {

/// A new type for `topic`; the caller owns one reference, which dds_create_topic_sertype takes over.
ddsi_sertype* make_raw_type(const TopicQos& topic);

/// Bytes of a sample of such a type: encapsulation header and CDR.
std::span<const std::byte> payload_of(const ddsi_serdata& data);

/// The key of a sample or a key-only serdata of such a type.
InstanceKey key_of(const ddsi_serdata& data);

}  // namespace swallowtail::record::cyclone
