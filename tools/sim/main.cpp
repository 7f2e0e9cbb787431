#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "planner/scenario/read.hpp"
#include "qos/fastdds/bus.hpp"
#include "qos/participant/run_loop.hpp"
#include "qos/participant/signals.hpp"
#include "tools/sim/sim_participant.hpp"

namespace {

constexpr double kPeriod_s = 0.005;
constexpr int kExitNotCompleted = 1;
constexpr int kExitUsage = 2;
constexpr int kExitFailed = 4;

constexpr const char* kExamples = R"(Examples:
  swallowtail-sim two_heights.yaml --domain 7 --rate 20 --await 1,2,3,5 --progress
  swallowtail-sim goal.yaml --await 1 --max-time 600
The last line of standard output is the mission's summary, one JSON object; with --progress there is one such line about twice per second before it.
Exit codes: 0 mission completed, 1 not completed (the reason is `status` in the summary), 2 bad scenario or usage, 4 the DDS participant failed.)";

struct Arguments {
  std::string scenario;
  std::uint32_t domain = 0;
  bool progress = false;
  swallowtail::sim::SimOptions options;
};

void declare(CLI::App& app, Arguments& arguments) {
  auto& options = arguments.options;
  app.add_option("scenario", arguments.scenario, "scenario file (YAML)")->required();
  app.add_option("--domain", arguments.domain, "DDS domain")
      ->check(CLI::Range(0U, swallowtail::kMaxDomain))
      ->capture_default_str();
  app.add_option("--rate", options.rate, "mission seconds per wall second")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  app.add_option("--await", options.await,
                 "ids of the participants that must be ready before the clock runs: 1 planner, 2 coverage, 3 "
                 "charger, 5 recorder")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--await-limit", options.await_limit_s, "wall seconds to wait for them")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--max-time", options.max_time_s, "mission seconds after which to give up")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed, "of weather and noise, and of the task")->capture_default_str();
  app.add_flag("--progress", arguments.progress, "print progress lines");
  app.footer(kExamples);
}

void print_line(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

int run(Arguments& arguments) {
  const auto scenario = swallowtail::planner::read_scenario(arguments.scenario);
  if (!scenario) {
    std::fprintf(stderr, "%s", scenario.errors().text().c_str());
    return kExitUsage;
  }
  if (arguments.progress) arguments.options.on_progress = print_line;
  const swallowtail::StopSignals stop;
  const swallowtail::SteadyClock clock;
  auto bus = swallowtail::make_fast_bus({.domain = arguments.domain, .participant_name = "swallowtail-sim"});
  if (!bus) {
    std::fprintf(stderr, "swallowtail-sim: %s\n", bus.error().message.c_str());
    return kExitFailed;
  }
  auto sim = swallowtail::sim::SimParticipant::make(**bus, clock, *scenario, arguments.options);
  if (!sim) {
    std::fprintf(stderr, "swallowtail-sim: %s\n", sim.error().message.c_str());
    return sim.error().code == swallowtail::Error::Code::kInternal ? kExitFailed : kExitUsage;
  }
  for (const std::string& refused : (*sim)->simulation().mission().refused) {
    std::fprintf(stderr, "swallowtail-sim: left out: %s\n", refused.c_str());
  }
  bool failed = false;
  const auto step = [&] {
    const auto more = (*sim)->step();
    if (more) return *more;
    std::fprintf(stderr, "swallowtail-sim: %s\n", more.error().message.c_str());
    failed = true;
    return false;
  };
  swallowtail::run_loop(stop, kPeriod_s, step);
  if (stop.requested() && !failed) {
    (*sim)->interrupt();
    while (step()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  print_line((*sim)->summary());
  if (failed) return kExitFailed;
  const auto& outcome = (*sim)->simulation().outcome();
  return outcome && outcome->completed ? 0 : kExitNotCompleted;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "The simulated world and aircraft: flies what the planner publishes and tells everyone what is true.");
  Arguments arguments;
  declare(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  return run(arguments);
}
