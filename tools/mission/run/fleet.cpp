#include "tools/mission/run/fleet.hpp"

#include <signal.h>

#include <utility>
#include <variant>

#include "planner/base/clock.hpp"
#include "tools/mission/run/locate.hpp"

namespace swallowtail::mission {
namespace {

constexpr double kPatience_s = 5.0;

std::string text(double value) {
  std::string digits = std::to_string(value);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

std::vector<std::string> charger_arguments(const planner::Scenario& scenario) {
  std::vector<std::string> arguments{"--charger", std::to_string(scenario.coverage->charger.id)};
  for (const auto& event : scenario.events) {
    if (const auto* delay = std::get_if<planner::ChargerDelay>(&event.what)) {
      arguments.push_back("--delay");
      arguments.push_back(text(event.at_s) + ":" + text(delay->delay_s));
    }
    if (const auto* loss = std::get_if<planner::ChargerLoss>(&event.what)) {
      arguments.push_back("--loss");
      arguments.push_back(text(event.at_s) + ":" + text(loss->energy));
    }
  }
  return arguments;
}

}  // namespace

Result<Fleet> Fleet::start(const planner::Scenario& scenario, const FleetOptions& options) {
  Fleet fleet;
  const std::string folder = program_folder() + "/";
  const std::string domain = std::to_string(options.domain);
  const auto add = [&](const std::string& program, std::vector<std::string> arguments) -> Status {
    std::vector<std::string> argv{folder + "swallowtail-" + program, "--domain", domain};
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    auto process = Process::start(program, argv);
    if (!process) return process.error();
    fleet.members_.push_back(std::move(process).value());
    return {};
  };

  std::string awaited = "1,5";
  if (auto s = add("record", {"-o", options.recording_file}); !s) return s.error();
  if (scenario.coverage) {
    awaited = "1,2,3,5";
    if (auto s = add("charger", charger_arguments(scenario)); !s) return s.error();
    if (auto s = add("coverage", {}); !s) return s.error();
  }
  if (auto s = add("planner", {"--vehicle", std::to_string(scenario.vehicle.id)}); !s) return s.error();
  std::vector<std::string> world{
      options.scenario_file,        "--rate",    text(options.rate), "--await", awaited, "--seed",
      std::to_string(options.seed), "--progress"};
  if (options.max_time_s > 0.0) world.insert(world.end(), {"--max-time", text(options.max_time_s)});
  if (auto s = add("sim", world); !s) return s.error();
  return fleet;
}

std::string Fleet::fallen() {
  for (auto& member : members_) {
    if (&member == &simulator()) continue;
    if (const auto code = member.poll())
      return "swallowtail-" + member.name() + " ended with exit code " + std::to_string(*code) + ": " +
             member.last_errors();
  }
  return {};
}

std::vector<std::string> Fleet::stop() {
  std::vector<std::string> killed;
  const auto end = [&killed](Process& member) {
    if (member.stop(kPatience_s) == 128 + SIGKILL) killed.push_back(member.name());
  };
  for (std::size_t i = members_.size(); i-- > 1;) members_[i].ask_to_stop();
  for (std::size_t i = members_.size(); i-- > 1;) end(members_[i]);
  if (!members_.empty()) end(members_.front());
  members_.clear();
  return killed;
}

}  // namespace swallowtail::mission
