#include <memory>

#include "tools/cli/input.hpp"
#include "tools/cli/output.hpp"
#include "tools/mission/check/rules_of.hpp"
#include "tools/mission/commands/commands.hpp"
#include "tools/mission/run/load_log.hpp"
#include "tools/mission/run/summary.hpp"

namespace swallowtail::cli {
namespace {

/// A recording held against its scenario.
struct Judged {
  planner::Scenario scenario;
  check::Rules rules;
  check::FlightLog log;
  mission::Summary summary;
};

Result<Judged> judge(planner::Scenario scenario, const std::string& recording) {
  auto rules = check::rules_of(scenario);
  if (!rules) return rules.error();
  auto log = mission::load_flight_log(recording, scenario);
  if (!log) return log.error();
  Judged judged{std::move(scenario), std::move(rules).value(), std::move(log).value(), {}};
  judged.summary = mission::summarize(judged.rules, judged.log, "recorded");
  judged.summary.recording = recording;
  return judged;
}

struct ReportArguments {
  Common common;
  std::string scenario;
  std::string recording;
};

Exit write(const ReportArguments& arguments) {
  Common common = arguments.common;
  if (common.output.empty()) common.output = "report.html";
  if (const Status status = check_output(common, {".html"}); !status.ok()) return fail(status.error());
  auto scenario = read_scenario_or_tell(arguments.scenario);
  if (!scenario) return Exit::kUsage;
  auto judged = judge(std::move(*scenario), arguments.recording);
  if (!judged) return fail(judged.error());
  judged->summary.report = common.output;
  if (const Status status =
          mission::write_report(judged->scenario, judged->rules, judged->log, judged->summary);
      !status.ok())
    return fail(status.error());
  common.output.clear();
  Answer answer;
  answer.json = nlohmann::ordered_json::parse(mission::summary_json(judged->summary));
  answer.table = mission::summary_text(judged->scenario, judged->summary);
  return deliver(common, answer, Exit::kDone);
}

}  // namespace

Exit check_recording(const RecordingCheck& request) {
  if (const Status status = check_output(request.common, {".json"}); !status.ok())
    return fail(status.error());
  auto scenario = read_scenario_or_tell(request.scenario);
  if (!scenario) return Exit::kUsage;
  const auto judged = judge(std::move(*scenario), request.recording);
  if (!judged) return fail(judged.error());
  Answer answer;
  answer.json = nlohmann::ordered_json::parse(mission::summary_json(judged->summary));
  answer.json.erase("status");
  answer.json["verdict"] = judged->summary.flight.ok() ? "certified" : "violations";
  answer.table = mission::summary_text(judged->scenario, judged->summary);
  return deliver(request.common, answer, judged->summary.flight.ok() ? Exit::kDone : Exit::kNone);
}

void add_report(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("report", "Draw the page of a recorded mission");
  const auto arguments = std::make_shared<ReportArguments>();
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (.yaml)")->required();
  command->add_option("RECORDING", arguments->recording, "Recorded mission (.mcap)")->required();
  add_common(*command, arguments->common,
             "  swallowtail report two_heights.yaml two_heights.mcap -o two_heights.html");
  command->callback([arguments, &exit] { exit = write(*arguments); });
}

}  // namespace swallowtail::cli
