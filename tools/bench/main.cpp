#include <CLI/CLI.hpp>

#include "tools/bench/commands.hpp"
#include "tools/cli/common.hpp"

int main(int argc, char** argv) {
  using swallowtail::cli::Exit;
  CLI::App app("swallowtail bench: measure, beside what one would use instead", "swallowtail bench");
  Exit exit = Exit::kDone;
  swallowtail::cli::prepare(app);
  swallowtail::bench::add_plan(app, exit);
  swallowtail::bench::add_scene(app, exit);
  swallowtail::bench::add_seeds(app, exit);
  swallowtail::bench::add_gtsp(app, exit);
  swallowtail::bench::add_cover(app, exit);
  return swallowtail::cli::run(app, exit, argc, argv);
}
