#pragma once

#include <CLI/CLI.hpp>

#include "tools/cli/exit.hpp"

/// One function for each bench: it adds the subcommand to `app`; when the user calls it, its exit code is
/// left in `exit`. What `exit` refers to must outlive parsing.
namespace swallowtail::bench {

void add_plan(CLI::App& app, cli::Exit& exit);
void add_scene(CLI::App& app, cli::Exit& exit);
void add_seeds(CLI::App& app, cli::Exit& exit);
void add_gtsp(CLI::App& app, cli::Exit& exit);
void add_cover(CLI::App& app, cli::Exit& exit);

}  // namespace swallowtail::bench
