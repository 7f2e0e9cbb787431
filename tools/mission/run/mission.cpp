#include "tools/mission/run/mission.hpp"

#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <optional>

#include "planner/base/clock.hpp"
#include "tools/mission/check/rules_of.hpp"
#include "tools/mission/run/load_log.hpp"
#include "tools/mission/run/progress.hpp"

namespace swallowtail::mission {
namespace {

/// Shows one line that renews itself on a terminal, or a line every few seconds elsewhere.
class Display {
 public:
  explicit Display(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) != 0) {}

  void show(const Progress& progress, double wall_s) {
    if (quiet_) return;
    if (terminal_) {
      std::fprintf(stderr, "\r\033[K%s", progress_line(progress).c_str());
      shown_ = true;
    } else if (wall_s - last_s_ >= 5.0) {
      std::fprintf(stderr, "%s\n", progress_line(progress).c_str());
      last_s_ = wall_s;
    }
  }

  void end() const {
    if (shown_) std::fputc('\n', stderr);
  }

 private:
  bool quiet_;
  bool terminal_;
  bool shown_ = false;
  double last_s_ = -1e9;
};

/// Follows the simulator until it ends, a participant falls or a stop is asked for; returns the mission's
/// status.
Result<std::string> watch(Fleet& fleet, Display& display, const std::atomic<bool>& stop_requested) {
  const SteadyClock clock;
  const double start_s = clock.now_s();
  std::string status = "the simulator gave no status";
  for (;;) {
    pollfd lines{fleet.simulator().out_fd(), POLLIN, 0};
    ::poll(&lines, 1, 100);
    const auto ended = fleet.simulator().poll();
    for (const auto& line : fleet.simulator().take_lines()) {
      if (const auto progress = parse_progress(line)) {
        display.show(*progress, clock.now_s() - start_s);
        if (!progress->status.empty()) status = progress->status;
      }
    }
    if (ended) {
      if (*ended > 1)
        return internal_error("swallowtail-sim ended with exit code " + std::to_string(*ended) + ": " +
                              fleet.simulator().last_errors());
      return status;
    }
    if (stop_requested) return std::string("interrupted");
    if (const std::string fallen = fleet.fallen(); !fallen.empty()) return internal_error(fallen);
  }
}

}  // namespace

Result<Summary> fly_mission(const planner::Scenario& scenario, const MissionOptions& options,
                            const std::atomic<bool>& stop_requested) {
  const auto rules = check::rules_of(scenario);
  if (!rules) return rules.error();
  const SteadyClock clock;
  const double start_s = clock.now_s();
  auto fleet = Fleet::start(scenario, options.fleet);
  if (!fleet) return fleet.error();
  Display display(options.quiet);
  const auto status = watch(*fleet, display, stop_requested);
  display.end();
  for (const auto& name : fleet->stop())
    std::fprintf(stderr, "mission: swallowtail-%s did not stop when asked and was killed\n", name.c_str());
  if (!status) return status.error();

  const auto log = load_flight_log(options.fleet.recording_file, scenario);
  if (!log) return log.error();
  Summary summary = summarize(*rules, *log, *status);
  summary.recording = options.fleet.recording_file;
  summary.report = options.report_file;
  summary.rate = options.fleet.rate;
  summary.wall_s = clock.now_s() - start_s;
  if (!options.report_file.empty()) {
    if (auto written = write_report(scenario, *rules, *log, summary); !written) return written.error();
  }
  return summary;
}

}  // namespace swallowtail::mission
