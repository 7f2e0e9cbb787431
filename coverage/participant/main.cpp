#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>

#include "coverage/participant/coverage_participant.hpp"
#include "qos/fastdds/bus.hpp"
#include "qos/participant/run_loop.hpp"
#include "qos/participant/signals.hpp"

namespace {

constexpr double kPeriod_s = 0.02;
constexpr int kExitUsage = 2;
constexpr int kExitFailed = 4;

constexpr const char* kExamples = R"(Examples:
  swallowtail-coverage --domain 7
  swallowtail-coverage --domain 7 --planning-s 30
Ends on SIGINT or SIGTERM. Exit codes: 0 ended by a signal, 2 bad usage, 4 the DDS participant failed.)";

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Plans the coverage of a CoverageTask's fields and keeps the plan true while it is flown.");
  std::uint32_t domain = 0;
  swallowtail::coverage::ParticipantOptions options;
  app.add_option("--domain", domain, "DDS domain")
      ->check(CLI::Range(0U, swallowtail::kMaxDomain))
      ->capture_default_str();
  app.add_option("--planning-s", options.planning_s, "wall time for the first plan")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  app.add_option("--strength", options.ownership_strength,
                 "of ownership: of several coverage participants the strongest is heard")
      ->check(CLI::Range(1U, 1'000'000U))
      ->capture_default_str();
  app.footer(kExamples);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }

  const swallowtail::StopSignals stop;
  options.stop_requested = &stop.flag();
  const swallowtail::SteadyClock clock;
  auto bus = swallowtail::make_fast_bus({.domain = domain, .participant_name = "swallowtail-coverage"});
  if (!bus) {
    std::fprintf(stderr, "swallowtail-coverage: %s\n", bus.error().message.c_str());
    return kExitFailed;
  }
  auto coverage = swallowtail::coverage::CoverageParticipant::make(**bus, clock, options);
  if (!coverage) {
    std::fprintf(stderr, "swallowtail-coverage: %s\n", coverage.error().message.c_str());
    return kExitFailed;
  }
  swallowtail::run_loop(stop, kPeriod_s, [&] {
    const swallowtail::Status done = (*coverage)->step();
    if (!done) std::fprintf(stderr, "swallowtail-coverage: %s\n", done.error().message.c_str());
    return true;
  });
  return 0;
}
