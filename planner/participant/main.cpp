#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <thread>

#include "planner/participant/planner_participant.hpp"
#include "qos/fastdds/bus.hpp"
#include "qos/participant/run_loop.hpp"
#include "qos/participant/signals.hpp"

namespace {

constexpr double kPeriod_s = 0.005;
constexpr double kBeat_s = 0.05;
constexpr int kExitUsage = 2;
constexpr int kExitFailed = 4;

constexpr const char* kExamples = R"(Examples:
  swallowtail-planner --domain 7
  swallowtail-planner --domain 7 --vehicle 2 --budget-ms 30
  swallowtail-planner --domain 7 --strength 5       # a hot standby: takes over when the stronger one falls silent
Ends on SIGINT or SIGTERM. Exit codes: 0 ended by a signal, 2 bad usage, 4 the DDS participant failed.)";

void complain(const swallowtail::Status& status) {
  if (!status) std::fprintf(stderr, "swallowtail-planner: %s\n", status.error().message.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Keeps a vehicle's path certified while the world and the coverage plan change.");
  swallowtail::BusOptions bus_options{.domain = 0, .participant_name = "swallowtail-planner"};
  swallowtail::planner::PlannerOptions options;
  app.add_option("--domain", bus_options.domain, "DDS domain")
      ->check(CLI::Range(0U, swallowtail::kMaxDomain))
      ->capture_default_str();
  app.add_option("--vehicle", options.vehicle_id, "for which vehicle")
      ->check(CLI::Range(1U, 1'000'000U))
      ->capture_default_str();
  app.add_option("--budget-ms", options.budget_ms, "wall time for the search of one replan")
      ->check(CLI::Range(1.0, 10000.0))
      ->capture_default_str();
  app.add_option("--obstacle-acceleration", options.obstacle_acceleration_mps2,
                 "m/s²; the most by which moving obstacles may turn or change speed: they get margin for it")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  app.add_option("--strength", options.ownership_strength, "ownership strength; below 10 it is a standby")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  app.footer(kExamples);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }

  const swallowtail::StopSignals stop;
  const swallowtail::SteadyClock clock;
  auto bus = swallowtail::make_fast_bus(bus_options);
  if (!bus) {
    complain(bus.error());
    return kExitFailed;
  }
  auto planner = swallowtail::planner::PlannerParticipant::make(**bus, clock, options);
  if (!planner) {
    complain(planner.error());
    return kExitFailed;
  }
  std::thread heart([&] {
    swallowtail::run_loop(stop, kBeat_s, [&] {
      complain((*planner)->beat());
      return true;
    });
  });
  swallowtail::run_loop(stop, kPeriod_s, [&] {
    complain((*planner)->step());
    return true;
  });
  heart.join();
  return 0;
}
