#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "planner/base/rng.hpp"
#include "tools/bench/plan/bench_case.hpp"
#include "tools/bench/plan/judge.hpp"
#include "tools/bench/plan/scene_families.hpp"

namespace swallowtail::bench {
namespace {

namespace fs = std::filesystem;

const std::string kData = std::string(SWALLOWTAIL_SOURCE_DIR) + "/tests/data/bench";

PlanCase case_of(const std::string& yaml, const std::string& name) {
  const fs::path file = fs::temp_directory_path() / (name + ".yaml");
  std::ofstream(file) << yaml;
  auto plan_case = load_case(file.string());
  fs::remove(file);
  EXPECT_TRUE(plan_case) << plan_case.error().message;
  return plan_case.value();
}

TEST(SceneFamilies, AreScenariosWhoseEndsAreFreeAndTheLineIsNot) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const auto& yaml : {hills_and_balls_yaml(seed), mixed_shapes_yaml(seed)}) {
      const PlanCase scene = case_of(yaml, "bench_scene_" + std::to_string(seed));
      const std::array line{scene.start_m, scene.goal_m};
      EXPECT_EQ(refusal_of(scene, std::array<Vec3, 2>{scene.start_m, scene.start_m}),
                "it does not lead from start to goal");
      EXPECT_NE(refusal_of(scene, line), "") << "seed " << seed;
      const Judge judge(scene);
      EXPECT_TRUE(judge.free(scene.start_m, scene.start_m)) << "seed " << seed;
      EXPECT_TRUE(judge.free(scene.goal_m, scene.goal_m)) << "seed " << seed;
    }
  }
}

TEST(SceneFamilies, AreTheSameForTheSameSeed) {
  EXPECT_EQ(hills_and_balls_yaml(5), hills_and_balls_yaml(5));
  EXPECT_NE(hills_and_balls_yaml(5), hills_and_balls_yaml(6));
}

TEST(SceneFamilies, ShippedFilesAreWhatTheSeedsGive) {
  for (const int seed : {1, 2, 3}) {
    std::ifstream file(kData + "/plan/hills_and_balls_" + std::to_string(seed) + ".yaml");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(text, hills_and_balls_yaml(static_cast<std::uint64_t>(seed)));
  }
}

TEST(Cases, EveryShippedSceneLoads) {
  const auto names = default_cases(kData);
  EXPECT_GE(names.size(), 6U);
  for (const std::string& name : names) {
    if (name == "big_world") continue;  // built in half a second; `bench plan big_world` does
    const auto plan_case = case_by_name(name, kData);
    ASSERT_TRUE(plan_case) << plan_case.error().message;
    EXPECT_EQ(plan_case->name, name);
  }
  EXPECT_FALSE(case_by_name("no_such_scene", kData));
}

// The judge is what everybody searches with, the certifier what everybody is judged by: other geometry, other
// code.
TEST(Judge, AgreesWithTheCertifierOnRandomSegments) {
  const PlanCase scene = case_of(mixed_shapes_yaml(3), "bench_scene_judge");
  const Judge judge(scene);
  Rng rng(4);
  int free = 0;
  int blocked = 0;
  for (int i = 0; i < 300; ++i) {
    PlanCase segment = scene;
    const auto point = [&rng] { return Vec3(rng.uniform(0, 100), rng.uniform(0, 100), rng.uniform(0, 40)); };
    segment.start_m = point();
    segment.goal_m = segment.start_m + 0.3 * (point() - segment.start_m);
    const std::array line{segment.start_m, segment.goal_m};
    const bool is_free = judge.free(line[0], line[1]);
    const bool certified = refusal_of(segment, line).empty();
    EXPECT_EQ(is_free, certified) << "segment " << i;
    EXPECT_EQ(is_free, judge.penalised(line).violation_m <= 0.0) << "segment " << i;
    ++(is_free ? free : blocked);
  }
  EXPECT_GT(free, 30);
  EXPECT_GT(blocked, 30);
}

TEST(Judge, MeasuresLongPolylinesHopByHop) {
  const PlanCase scene = case_of(mixed_shapes_yaml(3), "bench_scene_long");
  const Judge judge(scene);
  Rng rng(8);
  std::vector<Vec3> path;
  for (int i = 0; i < 21; ++i)
    path.emplace_back(rng.uniform(0, 100), rng.uniform(0, 100), rng.uniform(0, 40));
  double length_m = 0.0;
  double violation_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Judge::Penalised hop = judge.penalised(std::array{path[i - 1], path[i]});
    length_m += hop.length_m;
    violation_m += hop.violation_m;
  }
  const Judge::Penalised whole = judge.penalised(path);
  EXPECT_NEAR(whole.length_m, length_m, 1e-9 * length_m);
  EXPECT_NEAR(whole.length_m, length_of(path), 1e-9 * length_m);
  EXPECT_NEAR(whole.violation_m, violation_m, 1e-9 * (1.0 + violation_m));
}

}  // namespace
}  // namespace swallowtail::bench
