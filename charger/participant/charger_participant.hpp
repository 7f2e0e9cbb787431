#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "charger/charging/charging.hpp"
#include "idl/data/types.hpp"
#include "planner/base/clock.hpp"
#include "planner/base/mailbox.hpp"
#include "planner/base/result.hpp"
#include "qos/bus.hpp"
#include "qos/participant/due.hpp"
#include "qos/participant/mission_time.hpp"
#include "qos/participant/status.hpp"

namespace swallowtail::charger {

struct ParticipantOptions {
  std::uint32_t charger_id = 1;
  std::vector<Delay> delays{};
  std::vector<Loss> losses{};      ///< of its own battery, in mission time
  double publish_period_s = 0.02;  ///< wall time between two ChargerStates; changes of activity or charge
                                   ///< rate are published at once
};

/// Joins Charging to the wire: reads ChargerPlan, VehicleState, BatteryState and MissionClock, writes
/// ChargerState and ParticipantStatus. It publishes no ChargerState before the first plan for its charger,
/// because only a plan says where the robot stands. A mission clock that starts anew starts the robot anew.
class ChargerParticipant {
 public:
  static Result<std::unique_ptr<ChargerParticipant>> make(Bus& bus, const Clock& clock,
                                                          ParticipantOptions options);

  /// Takes what has arrived, moves the robot to the present mission time and publishes what is due.
  Status step();

  /// The mission clock says that the mission has ended.
  bool ended() const { return inbox_->time.ended(); }

 private:
  ChargerParticipant(Bus& bus, const Clock& clock, ParticipantOptions options);

  /// What the bus's threads hand over. Shared with the handlers, which may run until the bus is gone.
  struct Inbox {
    MissionTime time;
    Mailbox<data::ChargerPlan> plan;
    Mailbox<data::VehicleState> vehicle;
    Mailbox<data::BatteryState> battery;
    std::atomic<std::uint32_t> vehicle_id{0};  ///< of the plan; 0: not known yet
    std::atomic<double> capacity{0.0};         ///< of its battery; 0: not known yet
    std::atomic<double> heard_s{0.0};          ///< mission time of its newest state
    std::atomic<std::uint32_t> legs_done{0};
    std::atomic<double> since_s{0.0};  ///< that this aircraft flies: older states of a battery are another's
  };

  Status connect();
  Status subscribe();
  void take_plan(double time_s);
  void take_views();
  Status publish(const State& state);

  Bus& bus_;
  const Clock& clock_;
  const ParticipantOptions options_;
  const std::shared_ptr<Inbox> inbox_ = std::make_shared<Inbox>();
  std::unique_ptr<StatusPublisher> status_;
  std::unique_ptr<Publisher<data::ChargerState>> publisher_;

  std::optional<Charging> charging_;
  Orders orders_;
  Inputs inputs_;
  std::optional<data::ChargerState> published_;
  Due due_;
};

}  // namespace swallowtail::charger
