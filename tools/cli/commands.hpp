#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "tools/cli/common.hpp"
#include "tools/cli/exit.hpp"

/// One function for each subcommand: it adds the command to `app`; when the user calls it, its exit code is
/// left in `exit`. What `exit` refers to must outlive parsing.
namespace swallowtail::cli {

void add_plan(CLI::App& app, Exit& exit);
void add_tune(CLI::App& app, Exit& exit);
void add_cover(CLI::App& app, Exit& exit);
void add_gtsp(CLI::App& app, Exit& exit);
void add_terrain(CLI::App& app, Exit& exit);
void add_schema(CLI::App& app, Exit& exit);
/// Hands everything that follows to the program swallowtail-bench, which stands beside this one.
void add_bench(CLI::App& app, Exit& exit);

struct RecordingCheck {
  std::string scenario;
  std::string recording;
  Common common;
};
/// `check_recording` judges recorded missions; without it `--recording` is refused.
void add_check(CLI::App& app, Exit& exit, std::function<Exit(const RecordingCheck&)> check_recording);

}  // namespace swallowtail::cli
