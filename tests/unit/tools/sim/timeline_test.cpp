#include "tools/sim/timeline.hpp"

#include <gtest/gtest.h>

#include "scenario_fixture.hpp"

namespace swallowtail::sim {
namespace {

constexpr const char* kEvents = R"(
obstacles:
  - {id: 1, shape: sphere, center_m: [50, 50, 40], radius_m: 5}
  - {id: 2, shape: sphere, center_m: [80, 50, 40], radius_m: 5, valid_until_s: 30}
events:
  - {at_s: 10, obstacle: {id: 9, shape: sphere, center_m: [150, 150, 30], radius_m: 12, velocity_mps: [2, 0, 0]}}
  - {at_s: 20, move_obstacle: {id: 9, velocity_mps: [0, 1, 0]}}
  - {at_s: 40, battery_loss: 15}
  - {at_s: 50, remove_obstacle: 9}
)";

Timeline timeline() { return Timeline::make(scenario_with(kEvents), planner::Terrain::flat(0.0)).value(); }

TEST(Timeline, BeginsWithWhatIsKnown) {
  const Timeline start = timeline();
  EXPECT_EQ(start.world()->obstacles().size(), 2U);
  EXPECT_EQ(start.revision(1), 1U);
  EXPECT_EQ(start.revision(9), 0U);
  EXPECT_EQ(start.events_left(), 4U);
}

TEST(Timeline, TellsEachChangeOnceAtItsTime) {
  Timeline world = timeline();
  EXPECT_FALSE(world.advance(9.95).world_changed());
  const Changes appeared = world.advance(10.0);
  ASSERT_EQ(appeared.placed.size(), 1U);
  EXPECT_EQ(appeared.placed[0].id, 9U);
  EXPECT_EQ(world.revision(9), 1U);
  EXPECT_EQ(world.world()->obstacles().size(), 3U);
  EXPECT_FALSE(world.advance(10.0).world_changed());

  const Changes turned = world.advance(20.0);
  ASSERT_EQ(turned.placed.size(), 1U);
  EXPECT_LT((turned.placed[0].position_m - Vec3(170, 150, 30)).norm(), 1e-9);
  EXPECT_EQ(turned.placed[0].velocity_mps, Vec3(0, 1, 0));
  EXPECT_EQ(world.revision(9), 2U);

  const Changes over = world.advance(30.05);
  ASSERT_EQ(over.removed.size(), 1U);
  EXPECT_EQ(over.removed[0].id, 2U);
  EXPECT_EQ(world.advance(40.0).energy_lost, 15.0);

  const Changes gone = world.advance(60.0);
  ASSERT_EQ(gone.removed.size(), 1U);
  EXPECT_EQ(gone.removed[0].id, 9U);
  EXPECT_EQ(gone.removed[0].velocity_mps, Vec3(0, 1, 0)) << "with its last value";
  EXPECT_EQ(world.world()->obstacles().size(), 1U);
  EXPECT_EQ(world.events_left(), 0U);
}

TEST(Timeline, CatchesUpWithAllThatHappened) {
  Timeline world = timeline();
  const Changes changes = world.advance(45.0);
  EXPECT_EQ(changes.placed.size(), 2U);
  EXPECT_EQ(changes.energy_lost, 15.0);
  EXPECT_EQ(world.obstacles().size(), 2U);
}

}  // namespace
}  // namespace swallowtail::sim
