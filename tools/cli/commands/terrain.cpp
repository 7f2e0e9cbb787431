#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/core.h>

#include "planner/world/raster_file.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/terrain/generate.hpp"

namespace swallowtail::cli {
namespace {

struct TerrainOptions {
  Common common;
  TerrainParams params;
  std::vector<double> size_m = {800.0, 600.0};
  std::vector<double> origin;
};

std::optional<planner::GeoOrigin> origin_of(const TerrainOptions& options) {
  if (options.origin.empty()) return std::nullopt;
  return planner::GeoOrigin{options.origin[0], options.origin[1], options.origin[2]};
}

Exit run_terrain(const TerrainOptions& options) {
  if (options.common.output.empty()) return fail(bad_input("terrain: -o FILE.tif is required."));
  if (const Status status = check_output(options.common, {".tif", ".tiff"}); !status.ok())
    return fail(status.error());
  TerrainParams params = options.params;
  params.size_m = Vec2(options.size_m[0], options.size_m[1]);
  params.seed = options.common.seed;
  auto grid = generate_terrain(params);
  if (!grid) return fail(grid.error());
  if (const Status status = planner::write_terrain(options.common.output, *grid, origin_of(options));
      !status.ok())
    return fail(status.error());

  const auto [lo, hi] = std::ranges::minmax(grid->elevation_m);
  std::error_code error;
  const auto bytes = std::filesystem::file_size(options.common.output, error);
  Answer answer;
  answer.json = {{"status", "written"},
                 {"file", options.common.output},
                 {"rows", grid->rows},
                 {"cols", grid->cols},
                 {"cell_size_m", grid->cell_size_m},
                 {"min_m", lo},
                 {"max_m", hi},
                 {"bytes", bytes},
                 {"seed", params.seed}};
  answer.table = fmt::format("{}: {} × {} samples every {} m, {} to {} m, {} bytes\n", options.common.output,
                             grid->rows, grid->cols, grid->cell_size_m, lo, hi, bytes);
  Common print = options.common;
  print.output.clear();  // the file is written already
  return deliver(print, answer, Exit::kDone);
}

}  // namespace

void add_terrain(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("terrain", "Make a small sample terrain (GeoTIFF)");
  const auto options = std::make_shared<TerrainOptions>();
  const std::map<std::string, TerrainKind> kinds = {{"mountains", TerrainKind::kMountains},
                                                    {"hills", TerrainKind::kHills},
                                                    {"farmland", TerrainKind::kFarmland}};
  command->add_option("--kind", options->params.kind, "mountains, hills or farmland (two levels)")
      ->transform(CLI::CheckedTransformer(kinds))
      ->option_text("mountains|hills|farmland");
  command->add_option("--size-m", options->size_m, "East and north extent")
      ->expected(2)
      ->capture_default_str();
  command->add_option("--cell-m", options->params.cell_size_m, "Distance of samples")->capture_default_str();
  command->add_option("--relief-m", options->params.relief_m, "From the lowest to the highest sample")
      ->capture_default_str();
  command->add_option("--count", options->params.count, "Number of mountains, or of waves in hills")
      ->capture_default_str();
  command
      ->add_option(
          "--origin", options->origin,
          "Latitude, longitude (degrees) and elevation (m) of the south-west corner; without it local metres")
      ->expected(3);
  add_common(
      *command, options->common,
      "  swallowtail terrain --kind hills --size-m 400 300 --cell-m 5 --relief-m 30 --seed 4 -o hills.tif\n"
      "  swallowtail terrain --kind mountains --count 6 --relief-m 90 --origin 52.1 5.3 12 -o mountains.tif");
  command->callback([options, &exit] { exit = run_terrain(*options); });
}

}  // namespace swallowtail::cli
