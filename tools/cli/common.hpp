#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include "planner/base/result.hpp"
#include "tools/cli/exit.hpp"

namespace swallowtail::cli {

/// What every command takes.
struct Common {
  std::uint64_t seed = 1;
  int threads = 1;
  bool json = false;
  bool quiet = false;
  std::string output;  ///< empty: none
};

/// Adds the options and `examples` with the exit codes below the help text.
void add_common(CLI::App& command, Common& common, const std::string& examples);

/// What a program's commands inherit: call it before they are added.
void prepare(CLI::App& app);

/// Parses the program's command line, which runs the command named; `exit` is where that leaves its code.
/// Gives the process's exit code: usage errors and what is thrown have theirs.
int run(CLI::App& app, const Exit& exit, int argc, char** argv);

/// Set by SIGINT and SIGTERM once watch_signals was called. A second signal ends the process at once.
void watch_signals();
const std::atomic<bool>& interrupted();

/// Prints "swallowtail: message" to standard error and gives the exit code that belongs to the error.
Exit fail(const Error& error);

}  // namespace swallowtail::cli
