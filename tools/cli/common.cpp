#include "tools/cli/common.hpp"

#include <csignal>
#include <exception>

#include <fmt/core.h>

namespace swallowtail::cli {
namespace {

std::atomic<bool> stop_requested{false};

extern "C" void on_signal(int signal) {
  stop_requested.store(true, std::memory_order_relaxed);
  std::signal(signal, SIG_DFL);
}

}  // namespace

void add_common(CLI::App& command, Common& common, const std::string& examples) {
  command.add_option("--seed", common.seed, "Seed of all randomness")->capture_default_str();
  command.add_option("--threads", common.threads, "Threads to use")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command.add_flag("--json", common.json, "Print one JSON document on standard output and nothing else");
  command.add_option("-o,--output", common.output,
                     "Also write the answer to this file; its extension chooses the format");
  command.add_flag("-q,--quiet", common.quiet, "No table and no progress");
  command.footer("Examples:\n" + examples + "\n" + kExitCodesHelp);
}

void prepare(CLI::App& app) {
  app.require_subcommand(1);
  app.set_version_flag("--version", SWALLOWTAIL_VERSION);
  app.footer(kExitCodesHelp);
}

int run(CLI::App& app, const Exit& exit, int argc, char** argv) {
  watch_signals();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(Exit::kUsage);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: internal error: {}\n", app.get_name(), error.what());
    return static_cast<int>(Exit::kInternal);
  }
  return static_cast<int>(exit);
}

void watch_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

const std::atomic<bool>& interrupted() { return stop_requested; }

Exit fail(const Error& error) {
  fmt::print(stderr, "swallowtail: {}\n", error.message);
  switch (error.code) {
    case Error::Code::kBadInput:
    case Error::Code::kNotFound:
      return Exit::kUsage;
    case Error::Code::kInfeasible:
    case Error::Code::kTimeout:
      return Exit::kNone;
    case Error::Code::kInterrupted:
      return Exit::kInterrupted;
    case Error::Code::kInternal:
      break;
  }
  return Exit::kInternal;
}

}  // namespace swallowtail::cli
