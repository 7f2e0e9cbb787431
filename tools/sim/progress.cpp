#include "tools/sim/progress.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace swallowtail::sim {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, double digits) { return std::round(value * digits) / digits; }

Json describe(const Simulation& simulation, const Surroundings& surroundings) {
  const Motion& motion = simulation.motion();
  const Simulation::Tally& tally = simulation.tally();
  const Battery* battery = simulation.battery();
  Json line;
  line["time_s"] = rounded(simulation.time_s(), 1e3);
  line["state"] = name(surroundings.state);
  line["mode"] = name(motion.mode);
  line["position"] = {rounded(motion.position_m.x(), 1e2), rounded(motion.position_m.y(), 1e2),
                      rounded(motion.position_m.z(), 1e2)};
  line["covered_percent"] = rounded(simulation.covered_percent(), 1e2);
  line["energy"] = battery ? rounded(battery->energy(), 1e2) : 0.0;
  line["capacity"] = battery ? battery->capacity() : 0.0;
  line["legs_done"] = motion.legs_done;
  line["legs_total"] = tally.plan.legs_total;
  line["coverage_revision"] = tally.plan.revision;
  line["replans"] = tally.replans;
  line["verdict"] = tally.verdict ? Json(name(*tally.verdict)) : Json(nullptr);
  line["clearance_m"] = rounded(simulation.safety().clearance_m(), 1e2);
  line["violations"] = simulation.safety().violations();
  line["collisions"] = simulation.safety().collisions();
  line["recharges"] = tally.recharges;
  line["charger_activity"] = name(surroundings.charger_activity);
  return line;
}

}  // namespace

std::string_view name(data::VehicleMode mode) {
  switch (mode) {
    case data::VehicleMode::kLanded:
      return "landed";
    case data::VehicleMode::kTakingOff:
      return "taking off";
    case data::VehicleMode::kTransfer:
      return "transfer";
    case data::VehicleMode::kCovering:
      return "covering";
    case data::VehicleMode::kHolding:
      return "holding";
    case data::VehicleMode::kLanding:
      return "landing";
    case data::VehicleMode::kDocked:
      return "docked";
  }
  return "unknown";
}

std::string_view name(data::ChargerActivity activity) {
  switch (activity) {
    case data::ChargerActivity::kIdle:
      return "idle";
    case data::ChargerActivity::kDriving:
      return "driving";
    case data::ChargerActivity::kWaiting:
      return "waiting";
    case data::ChargerActivity::kCharging:
      return "charging";
    case data::ChargerActivity::kCarrying:
      return "carrying";
    case data::ChargerActivity::kReady:
      return "ready";
    case data::ChargerActivity::kRefilling:
      return "refilling";
    case data::ChargerActivity::kDelayed:
      return "delayed";
  }
  return "unknown";
}

std::string_view name(data::ClockState state) {
  switch (state) {
    case data::ClockState::kWaiting:
      return "waiting";
    case data::ClockState::kRunning:
      return "running";
    case data::ClockState::kEnded:
      return "ended";
  }
  return "unknown";
}

std::string_view name(data::PathVerdict verdict) {
  switch (verdict) {
    case data::PathVerdict::kCertified:
      return "certified";
    case data::PathVerdict::kContingency:
      return "contingency";
    case data::PathVerdict::kNoSafePath:
      return "no safe path";
  }
  return "unknown";
}

std::string progress_line(const Simulation& simulation, const Surroundings& surroundings) {
  return describe(simulation, surroundings).dump();
}

std::string summary_line(const Simulation& simulation, const Surroundings& surroundings) {
  Json line = describe(simulation, surroundings);
  const Simulation::Tally& tally = simulation.tally();
  const Safety& safety = simulation.safety();
  const bool over = simulation.outcome().has_value();
  line["final"] = true;
  line["status"] = over ? simulation.outcome()->reason : "interrupted";
  line["completed"] = over && simulation.outcome()->completed;
  line["flown_s"] = rounded(tally.flown_s, 1e3);
  line["contingencies"] = tally.contingencies;
  line["stale_starts"] = tally.stale_starts;
  line["energy_min"] =
      simulation.battery() ? Json(rounded(simulation.battery()->least_energy(), 1e2)) : Json(nullptr);
  line["clearance_min_m"] = std::isfinite(safety.least_clearance_m())
                                ? Json(rounded(safety.least_clearance_m(), 1e3))
                                : Json(nullptr);
  line["first_violation"] = safety.first_violation().empty() ? Json(nullptr) : Json(safety.first_violation());
  return line.dump();
}

}  // namespace swallowtail::sim
