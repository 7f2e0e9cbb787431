#include <exception>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "tools/bench/commands.hpp"
#include "tools/cli/common.hpp"

int main(int argc, char** argv) {
  using swallowtail::cli::Exit;
  CLI::App app("swallowtail bench: measure, beside what one would use instead", "swallowtail bench");
  Exit exit = Exit::kDone;
  app.require_subcommand(1);
  app.set_version_flag("--version", SWALLOWTAIL_VERSION);
  app.footer(swallowtail::cli::kExitCodesHelp);
  swallowtail::bench::add_plan(app, exit);
  swallowtail::bench::add_scene(app, exit);
  swallowtail::bench::add_seeds(app, exit);
  swallowtail::bench::add_gtsp(app, exit);
  swallowtail::cli::watch_signals();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(Exit::kUsage);
  } catch (const std::exception& error) {
    fmt::print(stderr, "swallowtail bench: internal error: {}\n", error.what());
    return static_cast<int>(Exit::kInternal);
  }
  return static_cast<int>(exit);
}
