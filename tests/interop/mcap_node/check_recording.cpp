// check_recording FILE STATES TILES BASE…: the project's own reader gives back, as plain values, what
// scenario.hpp sent.
#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "tests/interop/mcap_node/scenario.hpp"
#include "tools/record/recording/recording.hpp"

namespace {

using namespace swallowtail;

int g_problems = 0;

void expect(bool ok, const std::string& what) {
  if (ok) return;
  ++g_problems;
  std::cerr << "check_recording: " << what << '\n';
}

template <class T>
bool holds(const std::vector<recording::Timed<T>>& list, const T& value) {
  return std::any_of(list.begin(), list.end(), [&](const auto& timed) { return timed.value == value; });
}

void check(const recording::Recording& r, std::uint32_t base, std::uint32_t states, std::uint32_t tiles) {
  const std::string who = std::to_string(base) + ": ";
  std::uint32_t next = 0;
  for (const auto& timed : r.vehicle_states) {
    if (timed.value.vehicle_id != base) continue;
    expect(timed.value == record_test::vehicle_state(base, next),
           who + "vehicle state " + std::to_string(next));
    ++next;
  }
  expect(next == states, who + std::to_string(next) + " vehicle states");
  for (std::uint32_t i = 0; i < tiles; ++i) {
    expect(holds(r.terrain_tiles, record_test::terrain_tile(base, i, record_test::Sizes{}.tile_cells)),
           who + "tile " + std::to_string(i));
  }
  for (std::uint32_t i = 0; i < 3; ++i)
    expect(holds(r.obstacles, record_test::obstacle(base, i)), who + "obstacle " + std::to_string(i));
  expect(holds(r.coverage_tasks, record_test::coverage_task(base)), who + "coverage task");
  expect(holds(r.coverage_plans, record_test::coverage_plan(base)), who + "coverage plan");
  expect(holds(r.path_plans, record_test::path_plan(base)), who + "path plan");
  expect(holds(r.charger_plans, record_test::charger_plan(base)), who + "charger plan");
  expect(holds(r.participant_statuses, record_test::participant_status(base)), who + "status");
  const auto is_of = [base](const auto& timed) { return timed.value.vehicle_id == base; };
  expect(std::any_of(r.goals.begin(), r.goals.end(), is_of), who + "goal");
  expect(std::any_of(r.battery_states.begin(), r.battery_states.end(), is_of), who + "battery");
  const auto ending = std::find_if(r.endings.begin(), r.endings.end(), [&](const auto& e) {
    return e.value.topic == "Obstacle" && e.value.key[0] / 100 == base / 100;
  });
  expect(ending != r.endings.end() && ending->value.key == InstanceKey{base + 1} && ending->value.is_disposed,
         who + "disposed obstacle");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return 2;
  const auto recording = recording::load_recording(argv[1]);
  if (!recording) {
    std::cerr << "check_recording: " << recording.error().message << '\n';
    return 1;
  }
  const auto number = [&](int i) { return static_cast<std::uint32_t>(std::strtoul(argv[i], nullptr, 10)); };
  for (int i = 4; i < argc; ++i) check(*recording, number(i), number(2), number(3));
  expect(recording->is_complete && recording->problems.empty(), "the file is not complete");
  for (const auto& [what, count] : recording->refused)
    expect(false, what + " refused " + std::to_string(count) + " times");
  for (const auto& [topic, count] : recording->unknown) expect(false, "unknown topic " + topic);
  return g_problems == 0 ? 0 : 1;
}
