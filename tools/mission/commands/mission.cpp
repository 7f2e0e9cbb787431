#include <unistd.h>

#include <filesystem>
#include <memory>

#include "qos/options.hpp"
#include "tools/cli/input.hpp"
#include "tools/cli/output.hpp"
#include "tools/mission/commands/commands.hpp"
#include "tools/mission/run/mission.hpp"

namespace swallowtail::cli {
namespace {

struct MissionArguments {
  Common common;
  std::string scenario;
  std::string recording;
  std::string report;
  double rate = 20.0;
  double max_time_s = 0.0;
  int domain = 0;
};

/// A recording is always made, since the mission is judged by it; without --record it goes away afterwards.
class RecordingFile {
 public:
  explicit RecordingFile(const std::string& asked) : asked_(!asked.empty()) {
    const std::string name = "swallowtail-" + std::to_string(::getpid()) + ".mcap";
    path_ = asked_ ? std::filesystem::path(asked) : std::filesystem::temp_directory_path() / name;
  }
  ~RecordingFile() {
    std::error_code ignored;
    if (!asked_) std::filesystem::remove(path_, ignored);
  }
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;
  std::string path() const { return path_.string(); }
  bool asked() const { return asked_; }

 private:
  bool asked_;
  std::filesystem::path path_;
};

Exit exit_of(const mission::Summary& summary) {
  if (summary.status == "interrupted") return Exit::kInterrupted;
  return summary.good() ? Exit::kDone : Exit::kNone;
}

Exit fly(const MissionArguments& arguments) {
  if (const Status status = check_output(arguments.common, {".json"}); !status.ok())
    return fail(status.error());
  const auto scenario = read_scenario_or_tell(arguments.scenario);
  if (!scenario) return Exit::kUsage;
  const RecordingFile recording(arguments.recording);
  mission::MissionOptions options;
  options.fleet = {arguments.scenario, recording.path(),      arguments.rate,
                   arguments.domain,   arguments.common.seed, arguments.max_time_s};
  options.report_file = arguments.report;
  if (options.report_file.empty() && recording.asked())
    options.report_file = std::filesystem::path(recording.path()).replace_extension(".html").string();
  options.quiet = arguments.common.quiet;
  auto summary = mission::fly_mission(*scenario, options, interrupted());
  if (!summary) return fail(summary.error());
  if (!recording.asked()) summary->recording.clear();
  Answer answer;
  answer.json = nlohmann::ordered_json::parse(mission::summary_json(*summary));
  answer.table = mission::summary_text(*scenario, *summary);
  return deliver(arguments.common, answer, exit_of(*summary));
}

}  // namespace

void add_mission(CLI::App& app, Exit& exit) {
  CLI::App* command =
      app.add_subcommand("mission", "Fly a simulated mission over DDS (loopback), watch it, judge it");
  const auto arguments = std::make_shared<MissionArguments>();
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (.yaml)")->required();
  command->add_option("--rate", arguments->rate, "Mission seconds per wall second")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  command->add_option("--record", arguments->recording, "Keep the recording (.mcap)");
  command->add_option("--report", arguments->report,
                      "Write a self-contained page (.html), its pictures as SVG files beside it; with "
                      "--record alone it stands beside the "
                      "recording");
  command->add_option("--domain", arguments->domain, "DDS domain")
      ->check(CLI::Range(0, static_cast<int>(kMaxDomain)))
      ->capture_default_str();
  command
      ->add_option("--max-time", arguments->max_time_s,
                   "Give up after so many mission seconds; 0: the simulator's own limit")
      ->check(CLI::NonNegativeNumber);
  add_common(*command, arguments->common,
             "  swallowtail mission tests/data/missions/two_heights.yaml\n"
             "  swallowtail mission field.yaml --rate 5 --record field.mcap --report field.html\n"
             "  swallowtail mission field.yaml --json -q | jq .covered_percent");
  command->callback([arguments, &exit] { exit = fly(*arguments); });
}

}  // namespace swallowtail::cli
