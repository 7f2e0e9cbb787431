#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "charger/participant/charger_participant.hpp"
#include "planner/base/checks.hpp"
#include "qos/cyclone/bus.hpp"
#include "qos/participant/run_loop.hpp"
#include "qos/participant/signals.hpp"

namespace {

constexpr double kPeriod_s = 0.02;
constexpr int kExitUsage = 2;
constexpr int kExitFailed = 4;

constexpr const char* kExamples = R"(Examples:
  swallowtail-charger --domain 7
  swallowtail-charger --domain 7 --charger 2 --delay 120:45 --delay 600:10
Ends on SIGINT or SIGTERM. Exit codes: 0 ended by a signal, 2 bad usage, 4 the DDS participant failed.)";

bool parse_pair(const std::string& text, double& first, double& second) {
  std::istringstream in(text);
  char colon = 0;
  return (in >> first >> colon >> second) && colon == ':' && in.peek() == EOF &&
         swallowtail::is_non_negative(first) && swallowtail::is_non_negative(second);
}

std::string check_pair(const std::string& text, const char* form) {
  double first = 0.0;
  double second = 0.0;
  return parse_pair(text, first, second) ? std::string() : "'" + text + "' is not " + form;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "The ground robot: drives to the rendezvous of its ChargerPlan, charges the vehicle and carries it.");
  std::uint32_t domain = 0;
  swallowtail::charger::ParticipantOptions options;
  std::vector<std::string> delays;
  app.add_option("--domain", domain, "DDS domain")
      ->check(CLI::Range(0U, swallowtail::kMaxDomain))
      ->capture_default_str();
  app.add_option("--charger", options.charger_id, "which charger this is")
      ->check(CLI::Range(1U, 1'000'000U))
      ->capture_default_str();
  app.add_option("--delay", delays,
                 "AT_S:SECONDS of mission time in which it does not drive; may be repeated")
      ->allow_extra_args(false)
      ->check([](const std::string& text) { return check_pair(text, "AT_S:SECONDS, as in 120:45"); });
  std::vector<std::string> losses;
  app.add_option("--loss", losses,
                 "AT_S:UNITS that its own battery loses at once at that mission time; may be repeated")
      ->allow_extra_args(false)
      ->check([](const std::string& text) { return check_pair(text, "AT_S:UNITS, as in 120:30"); });
  app.footer(kExamples);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  for (const std::string& text : delays) {
    auto& delay = options.delays.emplace_back();
    parse_pair(text, delay.at_s, delay.duration_s);
  }
  for (const std::string& text : losses) {
    auto& loss = options.losses.emplace_back();
    parse_pair(text, loss.at_s, loss.energy);
  }

  const swallowtail::StopSignals stop;
  const swallowtail::SteadyClock clock;
  auto bus = swallowtail::make_cyclone_bus({.domain = domain, .participant_name = "swallowtail-charger"});
  if (!bus) {
    std::fprintf(stderr, "swallowtail-charger: %s\n", bus.error().message.c_str());
    return kExitFailed;
  }
  auto charger = swallowtail::charger::ChargerParticipant::make(**bus, clock, options);
  if (!charger) {
    std::fprintf(stderr, "swallowtail-charger: %s\n", charger.error().message.c_str());
    return kExitFailed;
  }
  swallowtail::run_loop(stop, kPeriod_s, [&] {
    const swallowtail::Status done = (*charger)->step();
    if (!done) std::fprintf(stderr, "swallowtail-charger: %s\n", done.error().message.c_str());
    return true;
  });
  return 0;
}
