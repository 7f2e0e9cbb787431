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

bool keeps(const Vec2& place, const std::vector<Vec2>& taken, double apart_m) {
  return std::ranges::all_of(
      taken, [&](const Vec2& other) { return (other - place).norm() >= apart_m * (1.0 - 1e-9); });
}

/// The first place on rings around `centre`, so far from each other, that may be used.
std::optional<Vec2> free_place(const Vec2& centre, double apart_m,
                               const std::function<bool(const Vec2&)>& is_usable) {
  for (int ring = 1; ring <= kRings; ++ring) {
    const int count = 6 * ring;
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / count;
      const Vec2 place = centre + apart_m * ring * Vec2(std::cos(angle), std::sin(angle));
      if (is_usable(place)) return place;
    }
  }
  return std::nullopt;
}

/// Where the robots stand, the first where the task says.
Result<std::vector<Vec2>> robots_at(const Task& task, const std::vector<Vec2>& starts,
                                    const StartsApart& apart) {
  const Vec2 start = task.start_m.head<2>();
  const Vec2 depot = task.charger.start_m.head<2>();
  const bool is_together = (depot - start).norm() < apart.aircraft_m;
  // From where no robot gets anywhere, it does not matter where they stand.
  const bool is_stranded = !std::isfinite(drive_s(task.charger, depot, depot));
  std::vector<Vec2> out;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    std::vector<Vec2> taken = out;
    for (std::size_t other = 0; other < starts.size(); ++other) {
      if (other != k) taken.push_back(starts[other]);
    }
    const auto is_usable = [&](const Vec2& place) {
      if (!keeps(place, taken, apart.robots_m)) return false;
      return is_stranded || (std::isfinite(drive_s(task.charger, depot, place)) &&
                             std::isfinite(drive_s(task.charger, place, depot)));
    };
    const Vec2 beside = depot + starts[k] - start;
    std::optional<Vec2> robot = k == 0 && !is_together ? std::optional(depot) : std::nullopt;
    if (is_together && is_usable(beside)) robot = beside;
    if (!robot) robot = free_place(depot, apart.aircraft_m, is_usable);
    if (!robot) robot = free_place(depot, apart.robots_m, is_usable);
    if (!robot)
      return infeasible("There is no room for " + std::to_string(starts.size()) +
                        " ground robots that can drive to each other around " + place_text(depot) + ".");
    out.push_back(*robot);
  }
  return out;
}

Result<std::vector<Task>> tasks_at(const Task& task, const std::vector<Vec2>& starts,
                                   const StartsApart& apart) {
  const Result<std::vector<Vec2>> robots = robots_at(task, starts, apart);
  if (!robots) return robots.error();
  std::vector<Task> out;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    Task one = task;
    one.start_m.head<2>() = starts[k];
    one.charger.start_m.head<2>() = (*robots)[k];
    one.vehicle_id = task.vehicle_id + static_cast<std::uint32_t>(k);
    one.charger.id = task.charger.id + static_cast<std::uint32_t>(k);
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace

Result<std::vector<Task>> tasks_of_fleet(const Task& task, int aircraft, const StartsApart& apart) {
  std::vector<Vec2> starts{task.start_m.head<2>()};
  const std::vector<Vec2> depot{task.charger.start_m.head<2>()};
  const auto is_open = [&](const Vec2& place) {
    return keeps(place, starts, apart.aircraft_m) && keeps(place, depot, apart.robots_m) &&
           !barred_at(task.fields, task.no_fly, place);
  };
  for (int k = 1; k < aircraft; ++k) {
    const auto start = free_place(starts.front(), apart.aircraft_m, is_open);
    if (!start)
      return infeasible("There is no room for " + std::to_string(aircraft) + " aircraft around the start.");
    starts.push_back(*start);
  }
  return tasks_at(task, starts, apart);
}

Result<std::vector<Task>> tasks_from_starts(const Task& task, int aircraft, const StartsApart& apart,
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
      if (!keeps(starts[k], {starts[other]}, apart.aircraft_m))
        return bad_input("The starts " + place_text(starts[other]) + " and " + place_text(starts[k]) +
                         " are nearer to each other than the aircraft must keep.");
    }
  }
  return tasks_at(task, starts, apart);
}

}  // namespace swallowtail::coverage
