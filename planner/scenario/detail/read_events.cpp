#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner/scenario/detail/read_parts.hpp"

namespace swallowtail::planner::detail {
namespace {

using Kind = ScenarioError::Kind;

constexpr Range kTime = from_to(0, kMaxTime_s);
constexpr Range kEnergy = above_to(0, 1e9);
constexpr std::size_t kMaxEvents = 10'000;

/// An event and where it stands in the file.
struct PlacedEvent {
  Event event;
  Section::Item item;
};

/// The one key of an event that says what happens; empty when there is none or more than one.
std::string kind_of(Section& section) {
  std::string kind;
  int count = 0;
  for (const char* key : {"obstacle", "move_obstacle", "remove_obstacle", "battery_loss", "charger_delay_s",
                          "charger_loss", "replace_aircraft"}) {
    if (!section.has(key)) continue;
    kind = key;
    ++count;
  }
  return count == 1 ? kind : "";
}

bool read_replacement(Section& section, Event& event) {
  auto one = section.section("replace_aircraft", Need::kRequired);
  if (!one || !one->is_map()) return false;
  AircraftReplaced what;
  bool ok = true;
  Vec2 start_m = Vec2::Zero();
  if (one->has("start_m")) {
    ok = one->vector("start_m", Need::kRequired, from_to(-kMaxXy_m, kMaxXy_m), start_m);
    what.start_m = start_m;
  }
  if (one->has("capacity")) ok = one->number("capacity", Need::kRequired, kEnergy, what.capacity) && ok;
  if (one->has("energy")) ok = one->number("energy", Need::kRequired, kEnergy, what.energy) && ok;
  one->finish();
  event.what = what;
  return ok;
}

bool read_what(Section& section, const std::string& kind, Event& event) {
  if (kind == "obstacle") {
    auto one = section.section("obstacle", Need::kRequired);
    ObstacleAppears what;
    if (!one || !read_obstacle(*one, event.at_s, what.obstacle)) return false;
    event.what = std::move(what);
    return true;
  }
  if (kind == "move_obstacle") {
    auto move = section.section("move_obstacle", Need::kRequired);
    if (!move || !move->is_map()) return false;
    ObstacleMoves what;
    bool ok = move->integer("id", Need::kRequired, kId, what.id);
    ok = move->vector("velocity_mps", Need::kRequired, from_to(-kMaxSpeed_mps, kMaxSpeed_mps),
                      what.velocity_mps) &&
         ok;
    move->finish();
    event.what = what;
    return ok;
  }
  if (kind == "remove_obstacle") {
    ObstacleVanishes what;
    const bool ok = section.integer("remove_obstacle", Need::kRequired, kId, what.id);
    event.what = what;
    return ok;
  }
  if (kind == "replace_aircraft") return read_replacement(section, event);
  if (kind == "battery_loss") {
    BatteryLoss what;
    const bool ok = section.number("battery_loss", Need::kRequired, kEnergy, what.energy);
    event.what = what;
    return ok;
  }
  if (kind == "charger_loss") {
    ChargerLoss what;
    const bool ok = section.number("charger_loss", Need::kRequired, kEnergy, what.energy);
    event.what = what;
    return ok;
  }
  ChargerDelay what;
  const bool ok = section.number("charger_delay_s", Need::kRequired, above_to(0, kMaxTime_s), what.delay_s);
  event.what = what;
  return ok;
}

/// Follows the events in time and logs those that cannot happen.
class EventChecker {
 public:
  EventChecker(const Scenario& scenario, ErrorLog& log) : scenario_(scenario), log_(log) {
    for (const Obstacle& obstacle : scenario.obstacles) present_.insert(obstacle.id);
  }

  void check(const PlacedEvent& placed) {
    const auto& what = placed.event.what;
    if (const auto* appears = std::get_if<ObstacleAppears>(&what)) {
      if (!present_.insert(appears->obstacle.id).second) {
        fail(placed, Kind::kDuplicate,
             "obstacle " + std::to_string(appears->obstacle.id) + " is there already at that time");
      }
    } else if (const auto* moves = std::get_if<ObstacleMoves>(&what)) {
      if (!present_.contains(moves->id)) fail_missing(placed, moves->id);
    } else if (const auto* vanishes = std::get_if<ObstacleVanishes>(&what)) {
      if (present_.erase(vanishes->id) == 0) fail_missing(placed, vanishes->id);
    } else if (!scenario_.coverage) {
      fail(placed, Kind::kRelation,
           "a battery_loss, charger_delay_s, charger_loss or replace_aircraft needs coverage");
    } else if (const auto* loss = std::get_if<BatteryLoss>(&what);
               loss && loss->energy > scenario_.coverage->battery.capacity) {
      fail(placed, Kind::kRelation, "battery_loss must be at most coverage.battery.capacity");
    } else if (std::holds_alternative<ChargerLoss>(what) && !scenario_.coverage->charger.battery) {
      fail(placed, Kind::kRelation, "a charger_loss needs coverage.charger.battery");
    } else if (const auto* other = std::get_if<AircraftReplaced>(&what)) {
      check_aircraft(placed, *other);
    }
  }

 private:
  void check_aircraft(const PlacedEvent& placed, const AircraftReplaced& other) {
    const BatterySpec& battery = scenario_.coverage->battery;
    const double capacity = other.capacity.value_or(battery.capacity);
    if (capacity > battery.capacity || capacity <= battery.reserve)
      fail(placed, Kind::kRelation, "capacity must be above the reserve, at most coverage.battery.capacity");
    const double energy = other.energy.value_or(capacity);
    if (energy > capacity || energy <= battery.reserve)
      fail(placed, Kind::kRelation, "energy must be above the reserve, at most the capacity");
    const Bounds& bounds = scenario_.bounds;
    if (other.start_m && !bounds.contains({other.start_m->x(), other.start_m->y(), bounds.min_m.z()}))
      fail(placed, Kind::kRelation, "start_m must be within bounds_m");
  }
  void fail(const PlacedEvent& placed, Kind kind, std::string rule) {
    log_.add(kind, placed.item.node->line, placed.item.path, "", std::move(rule));
  }
  void fail_missing(const PlacedEvent& placed, std::uint32_t id) {
    fail(placed, Kind::kRelation, "obstacle " + std::to_string(id) + " is not there at that time");
  }

  const Scenario& scenario_;
  ErrorLog& log_;
  std::set<std::uint32_t> present_;
};

}  // namespace

void read_events(Section& top, Scenario& scenario) {
  const auto items = top.list("events", Need::kOptional, 0, kMaxEvents);
  std::vector<PlacedEvent> placed;
  for (const Section::Item& item : items) {
    Section section(*item.node, item.path, top.log());
    if (!section.is_map()) continue;
    Event event;
    bool ok = section.number("at_s", Need::kRequired, kTime, event.at_s);
    const std::string kind = kind_of(section);
    if (kind.empty()) {
      top.log().add(
          Kind::kType, item.node->line, item.path, "",
          "must hold exactly one of obstacle, move_obstacle, remove_obstacle, battery_loss, charger_delay_s, "
          "charger_loss, replace_aircraft");
      ok = false;
    } else {
      ok = read_what(section, kind, event) && ok;
    }
    section.finish();
    if (ok) placed.push_back({std::move(event), item});
  }
  std::ranges::stable_sort(placed, {}, [](const PlacedEvent& p) { return p.event.at_s; });
  // An obstacle or event that was refused already would only make others look wrong.
  const bool is_whole = placed.size() == items.size() &&
                        scenario.obstacles.size() == top.count("obstacles") &&
                        (scenario.coverage || !top.has("coverage"));
  EventChecker checker(scenario, top.log());
  for (PlacedEvent& p : placed) {
    if (is_whole) checker.check(p);
    scenario.events.push_back(std::move(p.event));
  }
}

}  // namespace swallowtail::planner::detail
