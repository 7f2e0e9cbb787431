#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <memory>
#include <mutex>

#include "planner/base/result.hpp"
#include "qos/options.hpp"
#include "qos/topics.hpp"

namespace swallowtail::fast {

/// Owns a domain participant with its one publisher and subscriber, and makes each topic when it is first
/// asked for.
class Participant {
 public:
  static Result<std::unique_ptr<Participant>> create(const BusOptions& options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// Null when the type cannot be registered or the topic not made.
  eprosima::fastdds::dds::Topic* topic(const TopicQos& row, const eprosima::fastdds::dds::TypeSupport& type);
  eprosima::fastdds::dds::Publisher* publisher() { return publisher_; }
  eprosima::fastdds::dds::Subscriber* subscriber() { return subscriber_; }

 private:
  explicit Participant(eprosima::fastdds::dds::DomainParticipant* participant);

  eprosima::fastdds::dds::DomainParticipant* participant_;
  eprosima::fastdds::dds::Publisher* publisher_;
  eprosima::fastdds::dds::Subscriber* subscriber_;
  std::mutex mutex_;
};

}  // namespace swallowtail::fast
