#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/core.h>

#include "coverage/task/energy_of.hpp"
#include "planner/path/certifier.hpp"
#include "planner/world/clearance.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/energy.hpp"
#include "tools/cli/input.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/plan_file.hpp"

namespace swallowtail::cli {
namespace {

struct CheckOptions {
  Common common;
  std::string scenario;
  std::string plan;
  std::string recording;
};

constexpr double kSamePlace_m = 1e-6;

/// A plan that is safe to fly but begins or ends elsewhere than the scenario asks does not answer it.
std::vector<planner::Violation> check_ends(const planner::Scenario& scenario,
                                           const planner::TimedPath& path) {
  std::vector<planner::Violation> out;
  const auto add = [&out](const planner::TimedWaypoint& at, std::size_t segment, const char* rule) {
    out.push_back({planner::ViolationKind::kMalformed, at.time_s, at.position_m, 0, segment, rule});
  };
  if (scenario.start_m && scenario.goal_m) {
    if ((path.front().position_m - *scenario.start_m).norm() > kSamePlace_m)
      add(path.front(), 0, "The plan does not begin at start_m.");
    if ((path.back().position_m - *scenario.goal_m).norm() > kSamePlace_m)
      add(path.back(), path.size() - 1, "The plan does not end at goal_m.");
  }
  return out;
}

Answer answer_of(const CheckOptions& options, const Scene& scene, const planner::TimedPath& path,
                 const planner::Certificate& certificate) {
  Answer answer;
  auto& json = answer.json;
  json["scenario"] = scene.scenario.name;
  json["plan"] = options.plan;
  json["verdict"] = certificate.certified ? "certified" : "violations";
  json["violations"] = nlohmann::ordered_json::array();
  for (const auto& violation : certificate.violations) json["violations"].push_back(to_json(violation));
  json["clearance_min_m"] = certificate.clearance_min_m;
  json["length_m"] = planner::length_m(path);
  json["duration_s"] = path.back().time_s - path.front().time_s;
  json["energy_used"] = energy_of(path, coverage::energy_model_of(scene.scenario));
  json["energy_min"] = nullptr;
  if (scene.scenario.coverage)
    json["energy_min"] = scene.scenario.coverage->battery.capacity - json["energy_used"].get<double>();
  json["covered_percent"] = nullptr;

  answer.table = fmt::format("{}: {}\n  least clearance  {:.3f} m\n  length           {:.2f} m in {:.1f} s\n",
                             options.plan, json["verdict"].get<std::string>(), certificate.clearance_min_m,
                             planner::length_m(path), path.back().time_s - path.front().time_s);
  for (const auto& v : certificate.violations) {
    answer.table +=
        fmt::format("  t = {:8.2f} s  {:<9} at ({:.2f}, {:.2f}, {:.2f}){}: {}\n", v.time_s,
                    planner::name(v.kind), v.where_m.x(), v.where_m.y(), v.where_m.z(),
                    v.obstacle_id == 0 ? "" : fmt::format(" by obstacle {}", v.obstacle_id), v.detail);
  }
  return answer;
}

Exit check_plan(const CheckOptions& options) {
  if (const Status status = check_output(options.common, {".json"}); !status.ok())
    return fail(status.error());
  const auto scene = read_scene_or_tell(options.scenario);
  if (!scene) return Exit::kUsage;
  auto path = read_plan(options.plan);
  if (!path) return fail(path.error());
  const planner::ClearanceQuery query(scene->world);
  planner::Certificate certificate = planner::certify(*path, query, scene->scenario.vehicle.limits);
  for (auto& violation : check_ends(scene->scenario, *path))
    certificate.violations.push_back(std::move(violation));
  certificate.certified = certificate.certified && certificate.violations.empty();
  return deliver(options.common, answer_of(options, *scene, *path, certificate),
                 certificate.certified ? Exit::kDone : Exit::kNone);
}

}  // namespace

void add_check(CLI::App& app, Exit& exit, std::function<Exit(const RecordingCheck&)> check_recording) {
  CLI::App* command = app.add_subcommand("check", "Judge a plan, or a recorded mission, against a scenario");
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("SCENARIO", options->scenario, "Scenario file (.yaml)")->required();
  auto* group = command->add_option_group("what", "What to judge");
  group->add_option("--plan", options->plan, "Plan file, as `swallowtail plan --json` or -o writes it");
  group->add_option("--recording", options->recording, "Recorded mission (.mcap)");
  group->require_option(1);
  add_common(*command, options->common,
             "  swallowtail plan scene.yaml -o plan.json && swallowtail check scene.yaml --plan plan.json\n"
             "  swallowtail check two_heights.yaml --recording two_heights.mcap --json");
  command->callback([options, &exit, check_recording = std::move(check_recording)] {
    if (!options->plan.empty()) {
      exit = check_plan(*options);
    } else if (check_recording) {
      exit = check_recording({options->scenario, options->recording, options->common});
    } else {
      exit = fail(
          bad_input("check --recording: this swallowtail was built without DDS and reads no recordings."));
    }
  });
}

}  // namespace swallowtail::cli
