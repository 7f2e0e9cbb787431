#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tools/bench/cover/holed_field.hpp"
#include "tools/bench/cover/peers.hpp"
#include "tools/bench/cover/tasks.hpp"

namespace swallowtail::bench {
namespace {

TEST(HoledField, HolesKeepClearAndDependOnTheSeed) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const coverage::Polygon field = holed_field(seed);
    EXPECT_EQ(field.outline.size(), 11U);
    EXPECT_EQ(field.holes.size(), 15U) << seed;
    const auto cleaned = coverage::clean(field);
    ASSERT_TRUE(cleaned) << cleaned.error().message;
    ASSERT_EQ(cleaned->size(), 1U) << "no hole touches another or the outline";
    EXPECT_EQ(cleaned->front().holes.size(), field.holes.size());
    EXPECT_EQ(holed_field(seed).outline, field.outline);
    EXPECT_NE(holed_field(seed + 1).outline, field.outline);
  }
}

TEST(BandedTask, CanBePlanned) {
  const coverage::Task task = banded_task(20, 3);
  const Planned planned = plan_timed(task, 1);
  ASSERT_TRUE(planned.plan) << planned.plan.error().message;
  EXPECT_EQ(planned.plan->status, coverage::PlanStatus::kComplete);
  EXPECT_GE(planned.plan->sub_cells.size(), 20U);
  EXPECT_GT(planned.cpu_ms, 0.0);
}

TEST(CoverPeers, AreReadAndShown) {
  const auto peers = read_cover_peers(SWALLOWTAIL_SOURCE_DIR "/tests/data/bench/cover_peers.csv");
  ASSERT_TRUE(peers) << peers.error().message;
  EXPECT_THAT(peers_cell(*peers, "holes 15"), ::testing::HasSubstr("39 s"));
  EXPECT_EQ(peers_cell(*peers, "no such case"), "-");
  const auto file = std::filesystem::temp_directory_path() / "swallowtail_cover_peers.csv";
  std::ofstream(file) << "subject,case,seconds,remark\nx,y\n";
  const auto broken = read_cover_peers(file);
  ASSERT_FALSE(broken);
  EXPECT_THAT(broken.error().message, ::testing::HasSubstr(":2:"));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace swallowtail::bench
