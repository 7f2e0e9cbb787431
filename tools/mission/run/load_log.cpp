#include "tools/mission/run/load_log.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "tools/record/recording/recording.hpp"

namespace swallowtail::mission {
namespace {

constexpr double kCapacityTolerance = 1e-6;

template <class T, class Keep>
std::vector<T> kept(std::vector<recording::Timed<T>>& timed, Keep keep) {
  std::vector<T> values;
  for (auto& one : timed) {
    if (keep(one.value)) values.push_back(std::move(one.value));
  }
  return values;
}

template <class T>
void sort_by_time(std::vector<T>& samples) {
  std::stable_sort(samples.begin(), samples.end(),
                   [](const T& a, const T& b) { return a.time_s < b.time_s; });
}

}  // namespace

Result<check::FlightLog> load_flight_log(const std::string& recording_file,
                                         const planner::Scenario& scenario) {
  auto recording = recording::load_recording(recording_file);
  if (!recording) return recording.error();
  const double capacity =
      scenario.coverage ? scenario.coverage->battery.capacity : std::numeric_limits<double>::infinity();
  const auto of_vehicle = [vehicle_id = scenario.vehicle.id](const auto& sample) {
    return sample.vehicle_id == vehicle_id;
  };
  check::FlightLog log;
  log.states = kept(recording->vehicle_states, of_vehicle);
  log.batteries = kept(recording->battery_states, [&](const data::BatteryState& sample) {
    return of_vehicle(sample) && sample.energy <= capacity * (1.0 + kCapacityTolerance);
  });
  log.plans = kept(recording->path_plans, of_vehicle);
  log.coverage_plans = kept(recording->coverage_plans, of_vehicle);
  log.chargers = kept(recording->charger_states, [](const auto&) { return true; });
  sort_by_time(log.states);
  sort_by_time(log.batteries);
  sort_by_time(log.chargers);
  return log;
}

}  // namespace swallowtail::mission
