#pragma once

#include <string>
#include <string_view>

#include "planner/base/result.hpp"
#include "qos/topics.hpp"

namespace swallowtail {

/// The Error of a publisher whose sample data::validate refused.
inline Error refused(const TopicQos& topic, std::string_view reason) {
  return bad_input("The " + std::string(topic.name) + " sample is not published: " + std::string(reason) +
                   ".");
}

}  // namespace swallowtail
