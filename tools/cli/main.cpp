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
  swallowtail::cli::prepare(app);
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
  return swallowtail::cli::run(app, exit, argc, argv);
}
