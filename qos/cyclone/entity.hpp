#pragma once

#include <dds/dds.h>

#include <memory>
#include <string>
#include <utility>

#include "planner/base/result.hpp"

namespace swallowtail::cyclone {

/// Owns a handle of Cyclone DDS and with it the entities below it.
class Entity {
 public:
  Entity() = default;
  explicit Entity(dds_entity_t handle) : handle_(handle) {}
  ~Entity() { reset(); }
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    if (this != &other) {
      reset();
      handle_ = std::exchange(other.handle_, 0);
    }
    return *this;
  }

  dds_entity_t get() const { return handle_; }
  void reset() {
    if (handle_ > 0) dds_delete(handle_);
    handle_ = 0;
  }

 private:
  dds_entity_t handle_ = 0;
};

/// The owner of a handle that a dds_create_… call gave, or its error.
inline Result<Entity> owned(dds_entity_t handle, const std::string& what) {
  if (handle > 0) return Entity(handle);
  return internal_error("Cyclone DDS makes no " + what + ": " + dds_strretcode(handle) + ".");
}

struct DeleteQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, DeleteQos>;

struct DeleteListener {
  void operator()(dds_listener_t* listener) const { dds_delete_listener(listener); }
};
using Listener = std::unique_ptr<dds_listener_t, DeleteListener>;

}  // namespace swallowtail::cyclone
