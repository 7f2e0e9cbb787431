#include "tools/bench/plan/run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tools/bench/core/memory.hpp"
#include "tools/bench/plan/judge.hpp"

namespace swallowtail::bench {
namespace {

PlanCase five_spheres() {
  return case_by_name("five_spheres", std::string(SWALLOWTAIL_SOURCE_DIR) + "/tests/data/bench").value();
}

/// A planner whose path is given: longer by the seed.
Subject drawn(const std::string& name, std::vector<Vec3> middle) {
  return {name, "planner", [middle](const PlanCase& c, std::uint64_t seed, const RunLimit&) {
            std::vector<Vec3> path{c.start_m};
            for (const Vec3& p : middle) path.push_back(p + Vec3(0, 0.01 * static_cast<double>(seed), 0));
            path.push_back(c.goal_m);
            PlanRun run;
            run.path_m = path;
            run.curve = {{2.0, 10, 1, 2.0 * length_of(path)}, {4.0, 20, 2, length_of(path)}};
            run.evaluations = 20;
            run.cpu_ms = 5.0;
            return run;
          }};
}

const std::vector<Vec3> kAround{Vec3(1.0, 8.0, 1.0), Vec3(2.0, 10.5, 5.0)};

TEST(RunCase, CountsOnlyWhatTheCertifierAccepts) {
  cli::Progress progress("test", cli::Progress::Show::kNo);
  const PlanCase scene = five_spheres();
  Schedule schedule;
  schedule.runs = 3;
  const std::vector<Subject> subjects{drawn("through", {}), drawn("around", kAround)};
  const auto outcomes = run_case(scene, subjects, schedule, progress);
  ASSERT_EQ(outcomes.size(), 6U);
  EXPECT_FALSE(outcomes[0].certified());
  EXPECT_NE(outcomes[0].refusal, "");
  EXPECT_TRUE(outcomes[0].run.curve.empty());
  EXPECT_TRUE(outcomes[3].certified()) << outcomes[3].refusal;
  EXPECT_TRUE(std::isinf(outcomes[0].length_m()));
  EXPECT_DOUBLE_EQ(shortest_m(outcomes), outcomes[3].length_m());

  const double best_m = outcomes[3].length_m();
  const auto rows = rows_of(scene, subjects, outcomes, best_m);
  EXPECT_EQ(values_of(rows, "through", "five_spheres", "certified"), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(values_of(rows, "around", "five_spheres", "first_feasible"), (std::vector<double>{2, 2, 2}));
  EXPECT_EQ(values_of(rows, "around", "five_spheres", "time_to_1_percent"), (std::vector<double>{4, 4, 4}));
  EXPECT_EQ(values_of(rows, "around", "five_spheres", "evaluations_per_second"),
            (std::vector<double>{4000, 4000, 4000}));
  EXPECT_TRUE(std::isinf(values_of(rows, "through", "five_spheres", "time_to_5_percent").front()));
  const Table table = table_of(scene, subjects, rows, best_m);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0][1], "0 of 3");
  EXPECT_EQ(table.rows[0][2], "none");
  EXPECT_EQ(table.rows[1][1], "3 of 3");
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
}

TEST(RunCase, OrderDoesNotDependOnThreads) {
  cli::Progress progress("test", cli::Progress::Show::kNo);
  const PlanCase scene = five_spheres();
  Schedule schedule;
  schedule.runs = 8;
  const std::vector<Subject> subjects{drawn("around", kAround)};
  const auto one = run_case(scene, subjects, schedule, progress);
  schedule.threads = 3;
  const auto three = run_case(scene, subjects, schedule, progress);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].length_m(), three[i].length_m());
}

TEST(Subjects, OursFindCertifiedPathsInTheLimitTheyAreGiven) {
  cli::Progress progress("test", cli::Progress::Show::kNo);
  const PlanCase scene = five_spheres();
  Schedule schedule;
  schedule.runs = 1;
  schedule.limit.evaluations = 3000;
  const auto subjects = our_subjects();
  ASSERT_GE(subjects.size(), 2U);
  EXPECT_EQ(subjects.front().name, "plan_path");
  const auto outcomes = run_case(scene, subjects, schedule, progress);
  EXPECT_TRUE(outcomes.front().certified()) << outcomes.front().refusal << outcomes.front().run.failure;
  for (const Outcome& outcome : outcomes) {
    EXPECT_EQ(outcome.refusal, "") << subjects[outcome.subject].name;
    EXPECT_EQ(outcome.run.failure, "") << subjects[outcome.subject].name;
  }
}

TEST(Subjects, PeersFindCertifiedPathsToo) {
  cli::Progress progress("test", cli::Progress::Show::kNo);
  std::vector<std::string> missing;
  const auto subjects = peer_subjects(missing);
  if (subjects.empty()) GTEST_SKIP() << "built without OMPL and pagmo";
  Schedule schedule;
  schedule.runs = 1;
  schedule.limit.cpu_s = 0.02;
  for (const Outcome& outcome : run_case(five_spheres(), subjects, schedule, progress)) {
    const std::string& name = subjects[outcome.subject].name;
    EXPECT_EQ(outcome.refusal, "") << name;
    EXPECT_EQ(outcome.run.failure, "") << name;
    EXPECT_GT(outcome.run.evaluations, 0U) << name;
  }
}

TEST(PeakMemory, SeesWhatIsTaken) {
  const PeakMemory memory;
  std::vector<char> block(std::size_t{30} << 20U, 1);
  ASSERT_EQ(block.back(), 1);
  block = {};
  if (std::isnan(memory.taken_mb())) GTEST_SKIP() << "no /proc";
  EXPECT_GT(memory.taken_mb(), 25.0);
  EXPECT_LT(memory.taken_mb(), 60.0);
}

}  // namespace
}  // namespace swallowtail::bench
