#include "tools/mission/run/progress.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace swallowtail::mission {
namespace {

using Json = nlohmann::json;

template <class T>
void read(const Json& object, const char* key, T& value) {
  const auto found = object.find(key);
  if (found == object.end()) return;
  if constexpr (std::is_same_v<T, std::string>) {
    if (found->is_string()) value = found->get<std::string>();
  } else if (found->is_number()) {
    value = found->get<T>();
  }
}

}  // namespace

std::optional<Progress> parse_progress(const std::string& line) {
  const Json object = Json::parse(line, nullptr, false);
  if (!object.is_object()) return std::nullopt;
  Progress p;
  read(object, "time_s", p.time_s);
  read(object, "covered_percent", p.covered_percent);
  read(object, "energy", p.energy);
  read(object, "capacity", p.capacity);
  read(object, "replans", p.replans);
  read(object, "legs_done", p.legs_done);
  read(object, "legs_total", p.legs_total);
  read(object, "clearance_m", p.clearance_m);
  read(object, "recharges", p.recharges);
  read(object, "violations", p.violations);
  read(object, "mode", p.mode);
  read(object, "charger_activity", p.charger_activity);
  read(object, "verdict", p.verdict);
  read(object, "state", p.state);
  read(object, "status", p.status);
  return p;
}

std::string progress_line(const Progress& p) {
  char text[200];
  if (p.state == "waiting") {
    std::snprintf(text, sizeof text, "%7.1f s  waiting for participants and the first plan", p.time_s);
  } else if (p.capacity <= 0.0) {  // a flight to a goal: no battery, no field
    std::snprintf(text, sizeof text, "%7.1f s  replans %3d  clearance %6.1f m  %s", p.time_s, p.replans,
                  p.clearance_m, p.mode.c_str());
  } else {
    std::snprintf(
        text, sizeof text,
        "%7.1f s  covered %5.1f %%  battery %5.1f/%.0f  replans %3d  clearance %6.1f m  robot %-9s %s",
        p.time_s, p.covered_percent, p.energy, p.capacity, p.replans, p.clearance_m,
        p.charger_activity.c_str(), p.mode.c_str());
  }
  return text;
}

}  // namespace swallowtail::mission
