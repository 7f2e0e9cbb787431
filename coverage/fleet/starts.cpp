#include "coverage/fleet/starts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "coverage/field/places.hpp"

namespace swallowtail::coverage {
namespace {

constexpr int kRings = 100;

/// The first place on rings around `centre` that is far enough from those taken and that may be used.
std::optional<Vec2> free_place(const Vec2& centre, double apart_m, const std::vector<Vec2>& taken,
                               const std::function<bool(const Vec2&)>& is_usable) {
  for (int ring = 1; ring <= kRings; ++ring) {
    const int count = 6 * ring;
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / count;
      const Vec2 place = centre + apart_m * ring * Vec2(std::cos(angle), std::sin(angle));
      const bool is_free = std::ranges::all_of(
          taken, [&](const Vec2& other) { return (other - place).norm() >= apart_m * (1.0 - 1e-9); });
      if (is_free && is_usable(place)) return place;
    }
  }
  return std::nullopt;
}

}  // namespace

Result<std::vector<Task>> tasks_of_fleet(const Task& task, int aircraft, double apart_m) {
  std::vector<Task> out{task};
  std::vector<Vec2> starts{task.start_m.head<2>()};
  const Vec2 depot = task.charger.start_m.head<2>();
  std::vector<Vec2> robots{depot};
  const bool is_together = (depot - starts.front()).norm() < apart_m;
  const auto is_open = [&](const Vec2& place) { return !barred_at(task.fields, task.no_fly, place); };
  const auto is_reached = [&](const Vec2& place) {
    return std::isfinite(drive_s(task.charger, depot, place)) &&
           std::isfinite(drive_s(task.charger, place, depot));
  };
  for (int k = 1; k < aircraft; ++k) {
    Task one = task;
    const auto start = free_place(starts.front(), apart_m, starts, is_open);
    if (!start)
      return infeasible("There is no room for " + std::to_string(aircraft) + " aircraft around the start.");
    starts.push_back(*start);
    one.start_m.head<2>() = *start;
    const Vec2 beside = depot + *start - starts.front();
    std::optional<Vec2> robot;
    if (is_together && is_reached(beside)) {
      robot = beside;
    } else {
      robot = free_place(depot, apart_m, robots, is_reached);
    }
    robots.push_back(robot.value_or(depot));
    one.charger.start_m.head<2>() = robots.back();
    one.vehicle_id = task.vehicle_id + static_cast<std::uint32_t>(k);
    one.charger.id = task.charger.id + static_cast<std::uint32_t>(k);
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace swallowtail::coverage
