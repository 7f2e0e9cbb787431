#include <csignal>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "planner/base/rng.hpp"
#include "tests/golden/run.hpp"

namespace swallowtail {
namespace {

using nlohmann::json;

/// Clusters of five random points: large enough to keep the slow mode busy for minutes.
void write_large_instance(const std::string& path) {
  constexpr int kClusters = 200;
  constexpr int kSize = 5;
  std::ofstream out(path);
  out << "NAME: large\nTYPE: GTSP\nDIMENSION: " << kClusters * kSize << "\nGTSP_SETS: " << kClusters
      << "\nEDGE_WEIGHT_TYPE: EUC_2D\nNODE_COORD_SECTION\n";
  Rng rng(1);
  for (int i = 1; i <= kClusters * kSize; ++i)
    out << i << ' ' << rng.below(10000) << ' ' << rng.below(10000) << '\n';
  out << "GTSP_SET_SECTION\n";
  for (int c = 0; c < kClusters; ++c) {
    out << c + 1;
    for (int i = 1; i <= kSize; ++i) out << ' ' << c * kSize + i;
    out << " -1\n";
  }
  out << "EOF\n";
}

TEST(Interrupt, TheBestTourSoFarIsWrittenWithExitCode3) {
  const test::ScratchFolder folder;
  write_large_instance(folder.file("large.gtsp"));
  testing::Program program(test::swallowtail(
      {"gtsp", folder.file("large.gtsp"), "--mode", "slow", "--time-limit", "120", "--json"}));
  ASSERT_TRUE(program.wait_for_err("gtsp: 3 s", test::kLongestRun))
      << "progress is told from the third second on";
  program.send(SIGINT);
  EXPECT_EQ(program.finish(test::kLongestRun), 3) << program.err();
  const json answer = json::parse(program.out(), nullptr, false);
  ASSERT_FALSE(answer.is_discarded());
  EXPECT_EQ(answer["status"], "interrupted");
  EXPECT_EQ(answer["tour"].size(), 200u);
}

}  // namespace
}  // namespace swallowtail
