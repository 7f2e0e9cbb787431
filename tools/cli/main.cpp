#include <exception>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "tools/cli/commands.hpp"
#include "tools/cli/common.hpp"
#ifdef SWALLOWTAIL_WITH_MISSIONS
#include "tools/mission/commands/commands.hpp"
#endif

int main(int argc, char** argv) {
  using swallowtail::cli::Exit;
  CLI::App app("swallowtail: plans for UAVs that stay true while the world changes", "swallowtail");
  Exit exit = Exit::kDone;
  app.require_subcommand(1);
  app.set_version_flag("--version", SWALLOWTAIL_VERSION);
  app.footer(swallowtail::cli::kExitCodesHelp);
  swallowtail::cli::add_plan(app, exit);
  swallowtail::cli::add_tune(app, exit);
  swallowtail::cli::add_cover(app, exit);
  swallowtail::cli::add_gtsp(app, exit);
#ifdef SWALLOWTAIL_WITH_MISSIONS
  swallowtail::cli::add_mission(app, exit);
  swallowtail::cli::add_report(app, exit);
  swallowtail::cli::add_check(app, exit, swallowtail::cli::check_recording);
#else
  swallowtail::cli::add_check(app, exit, {});
#endif
  swallowtail::cli::add_terrain(app, exit);
  swallowtail::cli::add_schema(app, exit);
  swallowtail::cli::add_bench(app, exit);
  swallowtail::cli::watch_signals();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(Exit::kUsage);
  } catch (const std::exception& error) {
    fmt::print(stderr, "swallowtail: internal error: {}\n", error.what());
    return static_cast<int>(Exit::kInternal);
  }
  return static_cast<int>(exit);
}
