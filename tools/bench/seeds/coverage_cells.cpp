#include "tools/bench/seeds/coverage_cells.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "coverage/field/geojson.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::bench {
namespace {

constexpr double kHeightStep_m = 2.0;
constexpr std::uint64_t kHeights = 5;

double drawn_height_m(Rng& rng) { return kHeightStep_m * static_cast<double>(1 + rng.below(kHeights)); }

void add_cell(const Vec2& alpha_m, const Vec2& beta_m, double height_m, std::vector<coverage::SubCell>& out) {
  coverage::SubCell cell;
  cell.id = static_cast<std::uint32_t>(out.size());
  cell.alpha_m = Vec3(alpha_m.x(), alpha_m.y(), height_m);
  cell.beta_m = Vec3(beta_m.x(), beta_m.y(), height_m);
  cell.height_m = height_m;
  out.push_back(cell);
}

}  // namespace

Result<std::vector<StripLine>> strips_of_fields(const std::string& path, double sensor_width_m) {
  const auto file = coverage::read_fields(path, {});
  if (!file) return file.error();
  coverage::CutParams params;
  params.sensor_width_m = sensor_width_m;
  params.sweep_rad = 0.0;
  std::vector<StripLine> strips;
  for (const coverage::Field& field : file->fields) {
    const coverage::FieldCut cut = cut_field(field, planner::Terrain::flat(0.0), params);
    if (cut.status == coverage::FieldStatus::kRefused) return bad_input(cut.reason);
    for (const coverage::SubCell& cell : cut.sub_cells)
      strips.push_back({cell.alpha_m.head<2>(), cell.beta_m.head<2>()});
  }
  return strips;
}

Result<std::vector<StripLine>> read_strips(const std::string& path) {
  std::ifstream file(path);
  if (!file) return not_found("The file " + path + " cannot be opened.");
  std::vector<StripLine> strips;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream words(line);
    StripLine strip;
    double reached_alpha = 0.0;
    double reached_beta = 0.0;
    if (!(words >> strip.alpha_m.x() >> strip.alpha_m.y() >> reached_alpha >> strip.beta_m.x() >>
          strip.beta_m.y() >> reached_beta)) {
      return bad_input(path + ":" + std::to_string(number) + ": must have six numbers.");
    }
    strips.push_back(strip);
  }
  if (strips.empty()) return bad_input(path + " has no strip.");
  return strips;
}

std::optional<std::string> parents_file(const std::string& name) {
  const char* named = std::getenv("SWALLOWTAIL_DATA");
  const std::filesystem::path folder = named != nullptr ? named : SWALLOWTAIL_DEFAULT_DATA;
  const std::filesystem::path file = folder / "fields" / "yu_sites" / (name + ".txt");
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return std::nullopt;
  return file.string();
}

std::vector<coverage::SubCell> level_cells(const std::vector<StripLine>& strips, double height_m) {
  std::vector<coverage::SubCell> out;
  for (const StripLine& strip : strips) add_cell(strip.alpha_m, strip.beta_m, height_m, out);
  return out;
}

std::vector<coverage::SubCell> drawn_cells(const std::vector<StripLine>& strips, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<coverage::SubCell> out;
  for (const StripLine& strip : strips) {
    const double height_m = drawn_height_m(rng);
    const double other_m = drawn_height_m(rng);
    const double share = rng.uniform(1.0 / 3.0, 2.0 / 3.0);
    if (rng.below(2) == 0 || other_m == height_m) {
      add_cell(strip.alpha_m, strip.beta_m, height_m, out);
      continue;
    }
    const Vec2 middle_m = strip.alpha_m + share * (strip.beta_m - strip.alpha_m);
    add_cell(strip.alpha_m, middle_m, height_m, out);
    add_cell(middle_m, strip.beta_m, other_m, out);
  }
  return out;
}

double longest_m(const std::vector<coverage::SubCell>& cells) {
  double longest = 0.0;
  for (const coverage::SubCell& cell : cells)
    longest = std::max(longest, (cell.beta_m - cell.alpha_m).norm() + cell.height_m);
  return longest;
}

}  // namespace swallowtail::bench
