#pragma once

#include <span>
#include <string_view>

#include "qos/topics.hpp"

/// The data contract as a recorder sees it: the topics and the IDL text of their types.
namespace swallowtail::record {

/// Null where the contract has no such topic.
const TopicQos* find_topic(std::string_view name);

/// The self-contained, preprocessed IDL text which declares `type_name`; empty for a type that the contract
/// does not have.
std::string_view contract_idl(std::string_view type_name);

}  // namespace swallowtail::record
