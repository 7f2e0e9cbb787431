#include "coverage/fleet/starts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "coverage/field/places.hpp"
#include "planner/base/checks.hpp"

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

/// The task of each aircraft. A robot that stands beside its aircraft does so wherever this starts, if it can
/// drive from there; else it stands around its place, or in it.
std::vector<Task> tasks_at(const Task& task, const std::vector<Vec2>& starts, double apart_m) {
  std::vector<Task> out;
  const Vec2 start = task.start_m.head<2>();
  const Vec2 depot = task.charger.start_m.head<2>();
  const bool is_together = (depot - start).norm() < apart_m;
  const auto is_reached = [&](const Vec2& place) {
    return std::isfinite(drive_s(task.charger, depot, place)) &&
           std::isfinite(drive_s(task.charger, place, depot));
  };
  std::vector<Vec2> robots;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    Task one = task;
    one.start_m.head<2>() = starts[k];
    const Vec2 beside = depot + starts[k] - start;
    std::optional<Vec2> robot = k == 0 && !is_together ? std::optional(depot) : std::nullopt;
    if (is_together && is_reached(beside)) robot = beside;
    if (!robot) robot = free_place(depot, apart_m, robots, is_reached);
    robots.push_back(robot.value_or(depot));
    one.charger.start_m.head<2>() = robots.back();
    one.vehicle_id = task.vehicle_id + static_cast<std::uint32_t>(k);
    one.charger.id = task.charger.id + static_cast<std::uint32_t>(k);
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace

Result<std::vector<Task>> tasks_of_fleet(const Task& task, int aircraft, double apart_m) {
  std::vector<Vec2> starts{task.start_m.head<2>()};
  const auto is_open = [&](const Vec2& place) { return !barred_at(task.fields, task.no_fly, place); };
  for (int k = 1; k < aircraft; ++k) {
    const auto start = free_place(starts.front(), apart_m, starts, is_open);
    if (!start)
      return infeasible("There is no room for " + std::to_string(aircraft) + " aircraft around the start.");
    starts.push_back(*start);
  }
  return tasks_at(task, starts, apart_m);
}

Result<std::vector<Task>> tasks_from_starts(const Task& task, int aircraft, double apart_m,
                                            std::span<const Vec2> starts_m) {
  const auto count = static_cast<std::size_t>(aircraft);
  if (starts_m.size() < count) {
    return bad_input("There are " + std::to_string(starts_m.size()) + " starts for " +
                     std::to_string(aircraft) + " aircraft.");
  }
  const std::vector<Vec2> starts(starts_m.begin(), starts_m.begin() + aircraft);
  for (std::size_t k = 0; k < count; ++k) {
    if (!is_finite(starts[k])) return bad_input("A start must be two finite numbers of metres.");
    if (const auto barred = barred_at(task.fields, task.no_fly, starts[k]))
      return bad_input("The start " + place_text(starts[k]) + " lies within " + *barred + ".");
    for (std::size_t other = 0; other < k; ++other) {
      if ((starts[k] - starts[other]).norm() < apart_m * (1.0 - 1e-9))
        return bad_input("The starts " + place_text(starts[other]) + " and " + place_text(starts[k]) +
                         " are nearer to each other than the aircraft must keep.");
    }
  }
  return tasks_at(task, starts, apart_m);
}

}  // namespace swallowtail::coverage
