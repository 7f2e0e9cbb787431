#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "coverage/fleet/fleet.hpp"
#include "planner/base/rng.hpp"
#include "tests/property/coverage/replay_task.hpp"
#include "tests/support/replay_cover.hpp"

namespace swallowtail::coverage {
namespace {

using testing::IsEmpty;

constexpr double kTick_s = 0.1;
constexpr double kSlack_m = 1e-3;

/// The replay and the plan may differ by its time tolerance, over hills.
double slack_m(const test::ReplayTask& random) {
  if (random.terrain.is_flat()) return kSlack_m;
  const auto& limits = random.task.vehicle;
  return 2.0 * test::question_of(random).time_tolerance_s *
         std::max({limits.cruise_speed_mps, limits.climb_speed_mps, limits.descent_speed_mps});
}

std::uint64_t task_count() {
  const char* asked = std::getenv("SWALLOWTAIL_FLEET_TASKS");
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 40;
}

struct Body {
  Vec3 at_m;
  bool is_landed;
};

/// Places that a team takes up, by tick. Standing on the ground counts for every tick in between.
class Log {
 public:
  void stand(const Vec3& at_m, double from_s, double to_s) {
    for (long tick = tick_of(from_s) + 1; static_cast<double>(tick) * kTick_s <= to_s; ++tick)
      places_[tick].push_back({at_m, true});
  }
  void move(double from_s, const Vec3& from_m, double to_s, const Vec3& to_m, bool is_landed) {
    for (long tick = tick_of(from_s) + 1; static_cast<double>(tick) * kTick_s <= to_s; ++tick) {
      const double share = (static_cast<double>(tick) * kTick_s - from_s) / (to_s - from_s);
      places_[tick].push_back({from_m + (to_m - from_m) * share, is_landed});
    }
  }
  const std::map<long, std::vector<Body>>& places() const { return places_; }

 private:
  static long tick_of(double time_s) { return static_cast<long>(std::floor(time_s / kTick_s)); }
  std::map<long, std::vector<Body>> places_;
};

/// Where the replay drives the robot, and where it stands in between: on the ground below.
class RobotLog {
 public:
  RobotLog(Log& log, const Member& member, const test_support::GroundAt& ground)
      : log_(log), ground_(ground), at_m_(member.task.charger.start_m) {}
  void drive(double leaves_s, const Vec3& from_m, double arrives_s, const Vec3& to_m) {
    stand(leaves_s);
    // Heights change on the way.
    const int parts = std::max(1, static_cast<int>(std::ceil((to_m - from_m).head<2>().norm())));
    for (int i = 0; i < parts; ++i) {
      const auto at = [&](int part) {
        const Vec3 flat = from_m + (to_m - from_m) * (static_cast<double>(part) / parts);
        return Vec3(flat.x(), flat.y(), ground_(flat.x(), flat.y()));
      };
      const double part_s = (arrives_s - leaves_s) / parts;
      log_.move(leaves_s + i * part_s, at(i), leaves_s + (i + 1) * part_s, at(i + 1), true);
    }
    at_m_ = to_m;
    time_s_ = arrives_s;
  }
  void stand(double until_s) {
    log_.stand(Vec3(at_m_.x(), at_m_.y(), ground_(at_m_.x(), at_m_.y())), time_s_, until_s);
  }

 private:
  Log& log_;
  const test_support::GroundAt& ground_;
  Vec3 at_m_;
  double time_s_ = -kTick_s / 2.0;
};

/// When nothing moves any more.
double end_of(const FleetPlan& fleet) {
  double out = fleet.makespan_s;
  for (const Member& member : fleet.members) out = std::max(out, member.plan.robot_home_s);
  return out;
}

/// Flown and driven by the replay, which says where aircraft and robot are; what stands meanwhile is taken
/// from the plan.
Log log_of(const Member& member, const test::ReplayTask& random, double until_s,
           std::vector<std::string>& faults) {
  Log out;
  auto question = test::question_of(random);
  question.raster_m = 0.0;
  question.take_off_s = member.plan.take_off_s;
  double before_s = -1.0;
  Vec3 before_m = Vec3::Zero();
  question.watch = [&](double time_s, const Vec3& at_m) {
    const bool stands_anew = before_s < 0.0 || at_m.head<2>() != before_m.head<2>();
    const bool is_aloft = before_s >= 0.0 && time_s - before_s <= 2.0 * question.step_s;
    if (is_aloft) {
      out.move(before_s, before_m, time_s, at_m, false);
    } else if (before_s >= 0.0) {
      out.stand(before_m, before_s, time_s);
      if (stands_anew) out.stand(at_m, before_s, time_s);
    } else {
      out.stand(at_m, -kTick_s / 2.0, time_s);
    }
    before_s = time_s;
    before_m = at_m;
  };
  RobotLog robot(out, member, question.ground_m);
  question.watch_robot = [&](double leaves_s, const Vec3& from_m, double arrives_s, const Vec3& to_m) {
    robot.drive(leaves_s, from_m, arrives_s, to_m);
  };
  faults = test_support::replay(member.task, member.plan, question).faults;
  robot.stand(until_s);
  for (const Rendezvous& meeting : member.plan.rendezvous) {
    out.stand(meeting.site_m, std::min(meeting.robot_arrives_s, meeting.land_s), meeting.depart_s);
    if (meeting.carry) out.stand(meeting.carry_to_m, meeting.land_s, meeting.depart_s);
  }
  out.stand(before_m, before_s, until_s);
  return out;
}

double worst_breach_m(const Log& a, const Log& b, const Separation& separation) {
  double worst_m = 0.0;
  for (const auto& [tick, places] : a.places()) {
    const auto there = b.places().find(tick);
    if (there == b.places().end()) continue;
    for (const auto& [p, p_landed] : places) {
      for (const auto& [q, q_landed] : there->second) {
        const double level = std::hypot(p.x() - q.x(), p.y() - q.y());
        const double upright = std::abs(p.z() - q.z());
        const double asked = p_landed || q_landed ? separation.landed_m : separation.horizontal_m;
        const double below = p_landed && q_landed ? asked : separation.vertical_m - upright;
        worst_m = std::max(worst_m, std::min(asked - level, below));
      }
    }
  }
  return worst_m;
}

/// All members' legs as one plan's, for the cover's check.
Plan merged(const FleetPlan& fleet) {
  Plan out;
  out.fields = fleet.members.front().plan.fields;
  for (const Member& member : fleet.members)
    out.legs.insert(out.legs.end(), member.plan.legs.begin(), member.plan.legs.end());
  return out;
}

TEST(FleetProperty, TeamsCoverTheTaskOnceAndKeepTheirDistance) {
  const std::uint64_t tasks = task_count();
  std::uint64_t planned = 0;
  std::uint64_t delayed = 0;
  std::uint64_t unresolved = 0;
  double ratio = 0.0;
  for (std::uint64_t seed = 1; seed <= tasks; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const test::ReplayTask random = test::random_replay_task(seed);
    const auto alone = plan_coverage(random.task, random.terrain, random.options);
    if (!alone) continue;
    Rng rng(seed * 7919);
    FleetOptions options;
    options.aircraft = 2 + static_cast<int>(rng.below(3));
    options.separation.horizontal_m = rng.uniform(2.0, 15.0);
    options.separation.vertical_m = rng.uniform(1.0, 8.0);
    options.separation.landed_m = rng.uniform(0.5, 4.0);
    options.alone = &*alone;
    if (alone->sub_cells.size() < static_cast<std::size_t>(options.aircraft)) continue;
    const auto fleet = plan_fleet(random.task, random.terrain, random.options, options);
    if (!fleet) {
      ASSERT_EQ(fleet.error().code, Error::Code::kInfeasible) << fleet.error().message;
      ++unresolved;
      continue;
    }
    ++planned;
    ASSERT_EQ(fleet->members.size(), static_cast<std::size_t>(options.aircraft));
    std::set<std::uint32_t> flown;
    std::size_t legs = 0;
    std::vector<Log> logs;
    for (const Member& member : fleet->members) {
      std::vector<std::string> faults;
      logs.push_back(log_of(member, random, end_of(*fleet), faults));
      EXPECT_THAT(faults, IsEmpty());
      EXPECT_LE(member.plan.makespan_s, fleet->makespan_s);
      for (const Leg& leg : member.plan.legs) flown.insert(leg.sub_cell_id);
      legs += member.plan.legs.size();
      delayed += member.delay_s > 0.0 ? 1 : 0;
    }
    EXPECT_EQ(legs, alone->sub_cells.size());
    EXPECT_EQ(flown.size(), alone->sub_cells.size());
    double share = 1.0;
    EXPECT_THAT(test_support::faults_of_cover(random.task, merged(*fleet), test::question_of(random), share),
                IsEmpty());
    for (std::size_t i = 0; i < logs.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_LE(worst_breach_m(logs[i], logs[j], options.separation), slack_m(random)) << i << " and " << j;
    }
    ratio += fleet->makespan_s / alone->makespan_s;
  }
  EXPECT_GE(planned, tasks / 2) << "too many tasks are infeasible to say much";
  EXPECT_GE(delayed, tasks / 20) << "the tasks are too easy to say anything";
  EXPECT_LE(ratio / static_cast<double>(planned), 0.9);
  RecordProperty("planned", static_cast<int>(planned));
  RecordProperty("unresolved", static_cast<int>(unresolved));
  RecordProperty("delayed", static_cast<int>(delayed));
  RecordProperty("ratio_percent", static_cast<int>(100.0 * ratio / static_cast<double>(planned)));
}

}  // namespace
}  // namespace swallowtail::coverage
