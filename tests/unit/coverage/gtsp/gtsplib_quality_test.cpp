#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "coverage/gtsp/check_tour.hpp"
#include "coverage/gtsp/gtsplib.hpp"
#include "coverage/gtsp/solver.hpp"

namespace swallowtail::gtsp {
namespace {

std::filesystem::path data_folder() {
  return std::filesystem::path(SWALLOWTAIL_SOURCE_DIR) / ".." / "shared" / "data" / "gtsplib";
}

std::map<std::string, double> best_known() {
  std::map<std::string, double> costs;
  std::ifstream file(data_folder() / "best_known.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    const auto comma = line.find(',');
    if (comma != std::string::npos) costs[line.substr(0, comma)] = std::stod(line.substr(comma + 1));
  }
  return costs;
}

class GtsplibQuality : public testing::TestWithParam<const char*> {};

TEST_P(GtsplibQuality, FastModeComesWithinOnePercent) {
  const auto path = data_folder() / (std::string(GetParam()) + ".gtsp");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "The file " << path << " is missing.";
  const auto instance = read_gtsplib(path);
  ASSERT_TRUE(instance.ok()) << instance.error().message;
  const double best = best_known().at(GetParam());
  const Solution solution = solve(instance.value(), {.mode = Mode::kFast, .seed = 1});
  const auto checked = check_tour(instance.value(), solution.tour, {});
  ASSERT_TRUE(checked.ok()) << checked.error().message;
  EXPECT_EQ(checked.value(), solution.cost);
  EXPECT_GE(solution.cost, best);
  EXPECT_LE(solution.cost, 1.01 * best);
  EXPECT_LE(solution.lower_bound, best);
}

INSTANTIATE_TEST_SUITE_P(Files, GtsplibQuality,
                         testing::Values("11eil51", "20kroA100", "35ftv170", "40kroa200", "53gil262"));

}  // namespace
}  // namespace swallowtail::gtsp
