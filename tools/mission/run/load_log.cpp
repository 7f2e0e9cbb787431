#include "tools/mission/run/load_log.hpp"

#include <algorithm>
#include <utility>

#include "tools/record/recording/recording.hpp"

namespace swallowtail::mission {
namespace {

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

Result<check::FlightLog> load_flight_log(const std::string& recording_file, std::uint32_t vehicle_id) {
  auto recording = recording::load_recording(recording_file);
  if (!recording) return recording.error();
  const auto of_vehicle = [vehicle_id](const auto& sample) { return sample.vehicle_id == vehicle_id; };
  check::FlightLog log;
  log.states = kept(recording->vehicle_states, of_vehicle);
  log.batteries = kept(recording->battery_states, of_vehicle);
  log.plans = kept(recording->path_plans, of_vehicle);
  log.coverage_plans = kept(recording->coverage_plans, of_vehicle);
  log.chargers = kept(recording->charger_states, [](const auto&) { return true; });
  sort_by_time(log.states);
  sort_by_time(log.batteries);
  sort_by_time(log.chargers);
  return log;
}

}  // namespace swallowtail::mission
