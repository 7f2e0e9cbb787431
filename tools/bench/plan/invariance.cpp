#include "tools/bench/plan/invariance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>

#include <fmt/core.h>

#include "planner/base/rng.hpp"
#include "tools/bench/core/statistics.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {
namespace {

using planner::Obstacle;

constexpr double kSignificance = 0.01;
constexpr double kResolution = 1e-6;  ///< of start–goal
constexpr std::uint64_t kOtherSeeds = 1'000'000;
constexpr double kFar_m = 1e5;

planner::Shape scaled(planner::Shape shape, double s, double turn_rad) {
  std::visit(
      [&](auto& one) {
        using T = std::decay_t<decltype(one)>;
        if constexpr (std::is_same_v<T, planner::Box>) {
          one.size_m *= s;
          one.yaw_rad += turn_rad;
        } else if constexpr (std::is_same_v<T, planner::ConvexMesh>) {
          for (Vec3& v : one.vertices_m) v *= s;
          one.yaw_rad += turn_rad;
        } else {
          one.radius_m *= s;
          if constexpr (!std::is_same_v<T, planner::Sphere>) one.height_m *= s;
        }
      },
      shape);
  return shape;
}

const std::vector<Placement>& placements() {
  static const std::vector<Placement> all{
      {"shifted", 0.0, 1.0, Vec3(1234.5, -777.25, 310.0)},
      {"turned by 77°", 77.0 * std::numbers::pi / 180.0, 1.0, Vec3::Zero()},
      {"scaled by 3.7", 0.0, 3.7, Vec3::Zero()},
      {"all three", 2.0, 0.21, Vec3(-500.0, 42.0, 17.0)}};
  return all;
}

/// Lengths of a subject over the seeds from `first_seed` on, in units of the scene as it was.
struct Sample {
  std::vector<double> lengths_m;
  std::vector<std::vector<Vec3>> paths_m;
};

Sample sample(const PlanCase& plan_case, const Subject& subject, const Schedule& schedule, double scale,
              cli::Progress& progress) {
  Sample out;
  for (const Outcome& outcome : run_case(plan_case, {subject}, schedule, progress)) {
    out.lengths_m.push_back(outcome.length_m() / scale);
    out.paths_m.push_back(outcome.run.path_m);
  }
  return out;
}

/// Seeds that give the very same path at twice the size.
std::size_t same_at_twice(const Sample& base, const Sample& twice) {
  std::size_t same = 0;
  for (std::size_t i = 0; i < std::min(base.paths_m.size(), twice.paths_m.size()); ++i) {
    const auto& a = base.paths_m[i];
    const auto& b = twice.paths_m[i];
    same += std::ranges::equal(a, b, [](const Vec3& p, const Vec3& q) { return (2.0 * p - q).isZero(0.0); })
                ? 1
                : 0;
  }
  return same;
}

struct Verdict {
  std::string subject;
  std::string placement;
  double base_median_m = 0.0;
  double median_m = 0.0;
  double p_ranks = 1.0;
  double p_distribution = 1.0;
};

}  // namespace

Vec3 Placement::operator()(const Vec3& p) const {
  const double c = std::cos(turn_rad);
  const double s = std::sin(turn_rad);
  const Vec3 turned = turn_rad == 0.0 ? p : Vec3(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
  return scale * turned + shift_m;
}

PlanCase free_standing_case(std::uint64_t seed) {
  Rng rng(seed);
  PlanCase out;
  out.name = "free_standing";
  out.start_m = Vec3(0, 0, 0);
  out.goal_m = Vec3(32, 24, 8);
  out.limits.radius_m = 1e-6;
  out.limits.margin_m = 0.0;
  out.limits.climb_max_rad = std::numbers::pi / 2.0;
  out.limits.turn_max_rad = std::numbers::pi;
  out.waypoints = 4;
  std::vector<Obstacle> obstacles;
  for (int i = 0; i < 12; ++i) {
    const double along = (i + 1) / 13.0;
    const double size_m = rng.uniform(2.0, 4.0);
    Obstacle o;
    o.id = static_cast<std::uint32_t>(i + 1);
    o.position_m = out.start_m + along * (out.goal_m - out.start_m);
    if (i != 5) o.position_m += Vec3(rng.uniform(-6, 6), rng.uniform(-6, 6), rng.uniform(-6, 6));
    if (i % 3 == 0) o.shape = planner::Box{Vec3(size_m, 1.5 * size_m, 2.0 * size_m), rng.uniform(0.0, 3.0)};
    if (i % 3 == 1) o.shape = planner::Cylinder{0.7 * size_m, 3.0 * size_m};
    if (i % 3 == 2) o.shape = planner::Sphere{size_m};
    if ((o.position_m - out.start_m).norm() < 2.6 * size_m ||
        (o.position_m - out.goal_m).norm() < 4.0 * size_m)
      continue;
    obstacles.push_back(std::move(o));
  }
  out.world = planner::World::make(planner::Terrain::flat(-kFar_m / 100.0), obstacles,
                                   {Vec3(-kFar_m, -kFar_m, -kFar_m), Vec3(kFar_m, kFar_m, kFar_m)})
                  .value();
  return out;
}

PlanCase placed(const PlanCase& plan_case, const Placement& placement) {
  PlanCase out = plan_case;
  out.name = plan_case.name + ", " + placement.name;
  out.start_m = placement(plan_case.start_m);
  out.goal_m = placement(plan_case.goal_m);
  out.limits.radius_m *= placement.scale;
  out.limits.margin_m *= placement.scale;
  out.limits.cruise_speed_mps *= placement.scale;
  out.limits.climb_speed_mps *= placement.scale;
  out.limits.descent_speed_mps *= placement.scale;
  std::vector<Obstacle> obstacles;
  for (Obstacle o : plan_case.world->obstacles()) {
    o.position_m = placement(o.position_m);
    o.shape = scaled(o.shape, placement.scale, placement.turn_rad);
    obstacles.push_back(std::move(o));
  }
  const double far_m = kFar_m * placement.scale;
  const Vec3 corner(far_m, far_m, far_m);
  out.world = planner::World::make(
                  planner::Terrain::flat(placement.scale * plan_case.world->terrain().flat_elevation_m() +
                                         placement.shift_m.z()),
                  obstacles, {placement.shift_m - corner, placement.shift_m + corner})
                  .value();
  return out;
}

Invariance measure_invariance(const std::vector<Subject>& subjects, const Schedule& schedule,
                              cli::Progress& progress) {
  const PlanCase base_case = free_standing_case(schedule.first_seed);
  Schedule other = schedule;
  other.first_seed += kOtherSeeds;
  Invariance out;
  std::vector<Verdict> verdicts;
  std::vector<double> p_values;
  out.table.title =
      fmt::format("Invariance over {} seeds, {} evaluations each", schedule.runs, schedule.limit.evaluations);
  out.table.columns = {"subject", "placement",      "median m", "median moved ÷ scale",
                       "p ranks", "p distribution", "verdict"};
  std::vector<std::vector<std::string>> twice_rows;
  for (const Subject& subject : subjects) {
    if (cli::interrupted()) break;
    const Sample base = sample(base_case, subject, schedule, 1.0, progress);
    const auto keep = [&](const PlanCase& c, const Sample& s, std::uint64_t first) {
      for (std::size_t i = 0; i < s.lengths_m.size(); ++i)
        out.rows.push_back({subject.name, c.name, first + i, "length", s.lengths_m[i], "m"});
    };
    keep(base_case, base, schedule.first_seed);
    const double resolution_m = kResolution * base_case.distance_m();
    for (const Placement& placement : placements()) {
      if (cli::interrupted()) break;
      const PlanCase moved = placed(base_case, placement);
      const Sample lengths = sample(moved, subject, other, placement.scale, progress);
      keep(moved, lengths, other.first_seed);
      const auto a = rounded(base.lengths_m, resolution_m);
      const auto b = rounded(lengths.lengths_m, resolution_m);
      p_values.push_back(mann_whitney(a, b).p_value);
      p_values.push_back(kolmogorov_smirnov(a, b).p_value);
      verdicts.push_back({subject.name, placement.name, median_of(a), median_of(b), 0, 0});
    }
    const PlanCase twice = placed(base_case, {"twice as large", 0.0, 2.0, Vec3::Zero()});
    const std::size_t same = same_at_twice(base, sample(twice, subject, schedule, 2.0, progress));
    out.all_hold = out.all_hold && same == base.paths_m.size();
    out.rows.push_back({subject.name, twice.name, 0, "same_path", static_cast<double>(same), "runs"});
    twice_rows.push_back({subject.name, "twice as large", "–", "–", "–", "–",
                          fmt::format("the very same path in {} of {}", same, base.paths_m.size())});
  }
  const std::vector<double> raised = holm(p_values);
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const double p_ranks = raised[2 * i];
    const double p_distribution = raised[2 * i + 1];
    const bool holds = std::min(p_ranks, p_distribution) >= kSignificance;
    out.all_hold = out.all_hold && holds;
    out.table.rows.push_back({verdicts[i].subject, verdicts[i].placement,
                              significant(verdicts[i].base_median_m, 6), significant(verdicts[i].median_m, 6),
                              significant(p_ranks, 3), significant(p_distribution, 3),
                              holds ? "no difference seen" : "DIFFERENT"});
  }
  for (auto& row : twice_rows) out.table.rows.push_back(std::move(row));
  return out;
}

}  // namespace swallowtail::bench
