#pragma once

#include <utility>

#include "qos/bus.hpp"

namespace swallowtail {

/// Overrides what Bus asks for each type by templates of the bus: `Derived` gives
/// `open_publisher<T>(const PublisherOptions&)` and `open_subscription<T>(Handlers<T>)`.
template <class Derived, class... Ts>
class BusOver : public Bus {};

template <class Derived, class T, class... Rest>
class BusOver<Derived, T, Rest...> : public BusOver<Derived, Rest...> {
 private:
  Result<std::unique_ptr<Publisher<T>>> make_publisher(const T*, const PublisherOptions& options) final {
    return static_cast<Derived&>(*this).template open_publisher<T>(options);
  }
  Status make_subscription(const T*, Handlers<T> handlers) final {
    return static_cast<Derived&>(*this).template open_subscription<T>(std::move(handlers));
  }
};

template <class Derived>
using BusOfAllTopics =
    BusOver<Derived, data::TerrainTile, data::Obstacle, data::VehicleState, data::BatteryState,
            data::CoverageTask, data::Goal, data::MissionClock, data::CoveragePlan, data::ChargerPlan,
            data::PathPlan, data::ChargerState, data::ParticipantStatus>;

}  // namespace swallowtail
