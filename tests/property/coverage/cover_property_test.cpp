#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coverage/field/sub_cells.hpp"
#include "coverage/schedule/plan.hpp"
#include "planner/base/rng.hpp"
#include "tests/support/cover_oracle.hpp"

namespace swallowtail::coverage {
namespace {

Ring star(Rng& rng, const Vec2& centre, double least_m, double most_m, int corners) {
  Ring out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.7 * rng.uniform()) / corners;
    const double r = rng.uniform(least_m, most_m);
    out.emplace_back(centre.x() + r * std::cos(angle), centre.y() + r * std::sin(angle));
  }
  return out;
}

/// A star, concave as a rule, with up to nine holes that neither meet nor leave it.
Polygon random_ground(Rng& rng) {
  const double size = rng.uniform(60.0, 200.0);
  Polygon out{star(rng, Vec2(0, 0), 0.7 * size, 1.2 * size, 6 + static_cast<int>(rng.below(25))), {}};
  for (int i = 0; i < 9; ++i) {
    if (rng.uniform() < 0.4) continue;
    const Vec2 middle(0.28 * size * (i % 3 - 1), 0.28 * size * (i / 3 - 1));
    out.holes.push_back(star(rng, middle, 0.04 * size, 0.12 * size, 3 + static_cast<int>(rng.below(6))));
  }
  return out;
}

test_support::Ground ground_of(const std::vector<Polygon>& polygons) {
  test_support::Ground out;
  const auto add = [&](const Ring& ring) {
    out.rings.emplace_back();
    for (const Vec2& p : ring) out.rings.back().emplace_back(p.x(), p.y());
  };
  for (const Polygon& polygon : polygons) {
    add(polygon.outline);
    for (const Ring& hole : polygon.holes) add(hole);
  }
  return out;
}

test_support::FlownLine line_of(const Vec3& from, const Vec3& to) {
  return {{from.x(), from.y()}, {to.x(), to.y()}};
}

TEST(CoverProperty, RandomGroundIsCoveredFromInsideAndNoHoleIsCrossed) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    const Field field{1, "random", random_ground(rng), 20.0};
    CutParams params;
    params.sensor_width_m = rng.uniform(4.0, 16.0);
    const FieldCut cut = cut_field(field, planner::Terrain::flat(0.0), params);
    ASSERT_EQ(cut.status, FieldStatus::kPlanned) << cut.reason;
    std::vector<test_support::FlownLine> lines;
    for (const SubCell& cell : cut.sub_cells) lines.push_back(line_of(cell.alpha_m, cell.beta_m));
    const auto verdict = test_support::judge_cover(
        ground_of({field.polygon}), lines, {.width_m = params.sensor_width_m, .cell_m = 0.4, .step_m = 0.25});
    EXPECT_GE(verdict.covered_share, 0.999);
    EXPECT_EQ(verdict.outside_m, 0.0)
        << "at " << verdict.first_outside.first << ", " << verdict.first_outside.second;
    EXPECT_NEAR(verdict.covered_share, cut.covered_m2 / cut.area_m2, 5e-4);
  }
}

TEST(CoverProperty, NoFlyAreasAndHeadlandsAreKept) {
  for (std::uint64_t seed = 101; seed <= 110; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    const Field field{1, "random", random_ground(rng), 20.0};
    CutParams params;
    params.sensor_width_m = rng.uniform(5.0, 12.0);
    params.no_fly = {{star(rng, Vec2(50, 20), 20.0, 45.0, 7), {}}};
    params.rules.headland = seed % 2 == 0 ? Headland::kFly : Headland::kSkip;
    params.rules.headland_m = seed % 2 == 0 ? 2.0 * params.sensor_width_m : 4.0;
    const FieldCut cut = cut_field(field, planner::Terrain::flat(0.0), params);
    ASSERT_EQ(cut.status, FieldStatus::kPlanned) << cut.reason;
    EXPECT_GE(cut.covered_m2, 0.999 * cut.area_m2);
    std::vector<test_support::FlownLine> lines;
    for (const SubCell& cell : cut.sub_cells) lines.push_back(line_of(cell.alpha_m, cell.beta_m));
    const test_support::CoverQuestion question{.cell_m = 5.0, .step_m = 0.5};
    EXPECT_EQ(test_support::judge_cover(ground_of({field.polygon}), lines, question).outside_m, 0.0);
    const test_support::Ground no_fly = ground_of(params.no_fly);
    for (const test_support::FlownLine& line : lines) {
      for (int i = 0; i <= 50; ++i) {
        const double t = i / 50.0;
        const test_support::Point p{line.from.first + t * (line.to.first - line.from.first),
                                    line.from.second + t * (line.to.second - line.from.second)};
        EXPECT_FALSE(test_support::is_on(no_fly, p) && test_support::distance_to_border(no_fly, p) > 0.01);
      }
    }
  }
}

TEST(CoverProperty, TransfersStayInTheFieldAndOutOfItsHoles) {
  for (std::uint64_t seed = 201; seed <= 204; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    Task task;
    task.fields = {{1, "random", random_ground(rng), 20.0}};
    task.sensor_width_m = 14.0;
    task.start_m = Vec3(task.fields[0].polygon.outline[0].x(), task.fields[0].polygon.outline[0].y(), 0.0);
    task.charger.start_m = task.start_m;
    const auto plan = plan_coverage(task, planner::Terrain::flat(0.0), {});
    ASSERT_TRUE(plan.ok()) << plan.error().message;
    std::vector<test_support::FlownLine> lines;
    for (std::size_t i = 0; i + 1 < plan->legs.size(); ++i) {
      if (plan->legs[i].transfer == Transfer::kFDTU) continue;
      Vec3 at = plan->legs[i].exit_m;
      for (const Vec3& corner : plan->legs[i].transfer_m) {
        lines.push_back(line_of(at, corner));
        at = corner;
      }
      lines.push_back(line_of(at, plan->legs[i + 1].entry_m));
    }
    const auto verdict =
        test_support::judge_cover(ground_of({task.fields[0].polygon}), lines, {.cell_m = 5.0, .step_m = 0.5});
    EXPECT_EQ(verdict.outside_m, 0.0)
        << "at " << verdict.first_outside.first << ", " << verdict.first_outside.second;
  }
}

}  // namespace
}  // namespace swallowtail::coverage
