#include "tools/cli/cover_check.hpp"

#include <functional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "planner/scenario/read.hpp"
#include "tools/cli/cover_answer.hpp"
#include "tools/cli/cover_task.hpp"

namespace swallowtail::cli {
namespace {

struct Planned {
  CoverJob job;
  coverage::Plan plan;
};

/// A real plan with landings, made once.
const Planned& planned() {
  static const Planned kPlanned = [] {
    auto scenario = planner::read_scenario(std::string(SWALLOWTAIL_SOURCE_DIR) +
                                           "/tests/data/missions/battery_fault_late_robot.yaml");
    EXPECT_TRUE(scenario.ok()) << scenario.errors().text();
    auto job = job_of(scenario.value(), 1);
    EXPECT_TRUE(job.ok()) << job.error().message;
    auto plan = coverage::plan_coverage(job.value().tasks.front(), job.value().terrain, {});
    EXPECT_TRUE(plan.ok()) << plan.error().message;
    return Planned{std::move(*job), std::move(*plan)};
  }();
  return kPlanned;
}

TEST(CoverCheck, FindsNothingWrongWithARealPlan) {
  const auto faults = check_cover(planned().plan, planned().job.tasks.front());
  EXPECT_TRUE(faults.empty()) << faults.front();
  EXPECT_GE(planned().plan.rendezvous.size(), 2u);
}

TEST(CoverCheck, FindsEachKindOfFault) {
  using Plan = coverage::Plan;
  const std::pair<const char*, std::function<void(Plan&)>> faults[] = {
      {"a leg left out", [](Plan& p) { p.legs.erase(p.legs.begin() + 2); }},
      {"a leg twice", [](Plan& p) { p.legs.push_back(p.legs.front()); }},
      {"a leg of a sub-cell that is not there", [](Plan& p) { p.legs[1].sub_cell_id = 9999; }},
      {"a leg elsewhere", [](Plan& p) { p.legs[1].entry_m.x() += 1.0; }},
      {"legs that overlap", [](Plan& p) { p.legs[1].start_s = p.legs[0].end_s - 1.0; }},
      {"a leg too quick", [](Plan& p) { p.legs[1].end_s = p.legs[1].start_s + 0.1; }},
      {"energy from nowhere", [](Plan& p) { p.legs[1].energy_after = p.legs[1].energy_before + 1.0; }},
      {"energy above capacity", [](Plan& p) { p.legs[0].energy_before = 1e6; }},
      {"energy below the reserve", [](Plan& p) { p.legs[1].energy_after = 1.0; }},
      {"a landing below the reserve", [](Plan& p) { p.energy_min = 1.0; }},
      {"a robot too quick",
       [](Plan& p) { p.rendezvous.back().robot_arrives_s = p.rendezvous.front().depart_s; }},
      {"charging too quick",
       [](Plan& p) { p.rendezvous.front().depart_s = p.rendezvous.front().land_s + 0.5; }},
      {"charged above capacity", [](Plan& p) { p.rendezvous.front().charge_to = 1e4; }},
  };
  for (const auto& [what, spoil] : faults) {
    Plan plan = planned().plan;
    spoil(plan);
    EXPECT_FALSE(check_cover(plan, planned().job.tasks.front()).empty()) << what;
  }
}

TEST(CoverAnswer, HoldsTheStableFields) {
  const Covered done{&planned().job.tasks.front(), planned().plan, "", 0.1};
  const Answer answer = answer_of(planned().job, {done}, status_of({done}), 0.1);
  for (const char* key :
       {"status", "fields", "covered_percent", "cost", "makespan_s", "flight_m", "recharges", "wait_s",
        "vertices", "edges", "full_graph_gap_percent", "legs", "rendezvous", "energy_min", "wall_s"}) {
    EXPECT_TRUE(answer.json.contains(key)) << key;
  }
  for (const char* key : {"id", "status", "reason", "area_m2", "covered_m2", "outside_m2", "cells",
                          "sub_cells", "sweep_deg", "wall_ms"}) {
    EXPECT_TRUE(answer.json["fields"][0].contains(key)) << key;
  }
  for (const char* key : {"sub_cell", "from_m", "to_m", "height_m", "transfer", "energy_before",
                          "energy_after", "start_s", "end_s"}) {
    EXPECT_TRUE(answer.json["legs"][0].contains(key)) << key;
  }
  for (const char* key : {"site_m", "arrive_s", "depart_s", "charge"})
    EXPECT_TRUE(answer.json["rendezvous"][0].contains(key)) << key;
  EXPECT_EQ(answer.json["status"], "certified");
}

TEST(CoverAnswer, ATaskWithoutPlanRefusesItsFieldsWithTheReason) {
  const Covered done{&planned().job.tasks.front(), std::nullopt, "The battery is too small.", 0.1};
  EXPECT_EQ(status_of({done}), CoverStatus::kInfeasible);
  const Answer answer = answer_of(planned().job, {done}, CoverStatus::kInfeasible, 0.1);
  EXPECT_EQ(answer.json["fields"][0]["status"], "refused");
  EXPECT_EQ(answer.json["reason"], "The battery is too small.");
  EXPECT_TRUE(answer.json["cost"].is_null());
}

}  // namespace
}  // namespace swallowtail::cli
