#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "idl/data/types.hpp"
#include "planner/base/result.hpp"

/// The port through which participants see the wire. Three forms exist: qos/fastdds, qos/cyclone and
/// qos/memory (for tests); one contract suite runs on all of them.
namespace swallowtail {

/// The integer key fields of an instance in IDL order, unused ones 0.
using InstanceKey = std::array<std::uint32_t, 3>;

/// Handlers run on the receiving thread of the middleware and must only copy: hand the work to your own
/// thread.
template <class T>
struct Handlers {
  std::function<void(const T&)> on_sample;            ///< decoded and validated
  std::function<void(const InstanceKey&)> on_gone{};  ///< disposed, or no writer is left
};

/// Writes one topic. Publishing never waits for a reader.
template <class T>
class Publisher {
 public:
  virtual ~Publisher() = default;
  /// Refuses what `data::validate` refuses.
  virtual Status publish(const T& sample) = 0;
  /// Ends the instance of `last`; readers get on_gone.
  virtual Status dispose(const T& last) = 0;
  /// Keeps ownership of what was last published (manual-by-topic liveliness).
  virtual void assert_liveliness() = 0;
};

struct PublisherOptions {
  std::int32_t ownership_strength = 10;  ///< used by topics of exclusive ownership only
};

template <class T>
class Endpoint {
 public:
  virtual ~Endpoint() = default;

 private:
  friend class Bus;
  virtual Result<std::unique_ptr<Publisher<T>>> make_publisher(const T* type,
                                                               const PublisherOptions& options) = 0;
  virtual Status make_subscription(const T* type, Handlers<T> handlers) = 0;
};

/// What ParticipantStatus reports of the wire.
struct BusStatistics {
  std::uint64_t accepted = 0;
  std::vector<data::Rejection> rejected;
  std::uint64_t missed_deadlines = 0;
  std::uint64_t incompatible_qos = 0;
};

/// One DDS participant. QoS of every endpoint comes from the table in qos/topics.hpp. Publishers must not
/// outlive it; subscriptions live as long as it does, and no handler runs after its destructor.
class Bus : public Endpoint<data::TerrainTile>,
            public Endpoint<data::Obstacle>,
            public Endpoint<data::VehicleState>,
            public Endpoint<data::BatteryState>,
            public Endpoint<data::CoverageTask>,
            public Endpoint<data::Goal>,
            public Endpoint<data::MissionClock>,
            public Endpoint<data::CoveragePlan>,
            public Endpoint<data::ChargerPlan>,
            public Endpoint<data::PathPlan>,
            public Endpoint<data::ChargerState>,
            public Endpoint<data::ParticipantStatus> {
 public:
  template <class T>
  Result<std::unique_ptr<Publisher<T>>> publisher(const PublisherOptions& options = {}) {
    return static_cast<Endpoint<T>&>(*this).make_publisher(nullptr, options);
  }

  template <class T>
  Status subscribe(Handlers<T> handlers) {
    return static_cast<Endpoint<T>&>(*this).make_subscription(nullptr, std::move(handlers));
  }

  virtual BusStatistics statistics() const = 0;

  /// Counts a sample that is well formed but must not be acted on (an unknown vehicle, a battery above the
  /// task's capacity). `reason` is a string literal.
  virtual void count_rejection(std::string_view topic, std::string_view reason) = 0;
};

}  // namespace swallowtail
