#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "qos/bus.hpp"

namespace swallowtail::record {

/// Bytes that belong to a middleware until they are let go of.
class Payload {
 public:
  using Release = void (*)(void* owner);

  Payload() = default;
  Payload(std::span<const std::byte> bytes, void* owner, Release release)
      : bytes_(bytes), owner_(owner), release_(release) {}
  Payload(Payload&& other) noexcept
      : bytes_(std::exchange(other.bytes_, {})),
        owner_(std::exchange(other.owner_, nullptr)),
        release_(other.release_) {}
  Payload& operator=(Payload&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    std::swap(owner_, other.owner_);
    std::swap(release_, other.release_);
    return *this;
  }
  ~Payload() {
    if (owner_ != nullptr) release_(owner_);
  }

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
  void* owner_ = nullptr;
  Release release_ = nullptr;
};

enum class EventKind : std::uint8_t { kSample, kDispose, kUnregister };
enum class Vendor : std::uint8_t { kUnknown, kFastDds, kCycloneDds };

/// Something that came from the wire.
struct Event {
  std::size_t topic = 0;  ///< index into the session's topics
  EventKind kind = EventKind::kSample;
  Vendor vendor = Vendor::kUnknown;
  std::uint64_t log_time_ns = 0;      ///< reception, wall clock
  std::uint64_t publish_time_ns = 0;  ///< the writer's source timestamp
  InstanceKey key{};
  Payload payload;  ///< encapsulation header and CDR; empty unless kSample
};

}  // namespace swallowtail::record
