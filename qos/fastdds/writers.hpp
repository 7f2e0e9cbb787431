#pragma once

#include <fastdds/rtps/common/InstanceHandle.h>
#include <algorithm>
#include <map>
#include <vector>

#include "qos/bus.hpp"

namespace swallowtail::fast {

/// Which writers each instance at a reader has had samples from. This vendor's readers tell of a dispose, but
/// not of an instance whose last writer has left or lost its liveliness. Allocates when an instance or a
/// writer of it is new.
class Writers {
 public:
  using Handle = eprosima::fastrtps::rtps::InstanceHandle_t;

  void wrote(const InstanceKey& key, const Handle& writer) {
    std::vector<Handle>& writers = instances_[key];
    if (std::find(writers.begin(), writers.end(), writer) == writers.end()) writers.push_back(writer);
  }

  void forget(const InstanceKey& key) { instances_.erase(key); }

  /// The instances that have lost their last writer.
  std::vector<InstanceKey> leave(const Handle& writer) {
    return remove_if([&writer](std::vector<Handle>& writers) {
      std::erase(writers, writer);
      return writers.empty();
    });
  }
  std::vector<InstanceKey> leave_all() {
    return remove_if([](const std::vector<Handle>&) { return true; });
  }

 private:
  template <class Condition>
  std::vector<InstanceKey> remove_if(Condition is_over) {
    std::vector<InstanceKey> keys;
    for (auto it = instances_.begin(); it != instances_.end();) {
      if (is_over(it->second)) {
        keys.push_back(it->first);
        it = instances_.erase(it);
      } else {
        ++it;
      }
    }
    return keys;
  }

  std::map<InstanceKey, std::vector<Handle>> instances_;
};

}  // namespace swallowtail::fast
