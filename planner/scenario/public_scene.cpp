#include "planner/scenario/public_scene.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <vector>

#include "planner/world/raster_file.hpp"

namespace swallowtail::planner {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxBytes = 1u << 20u;
constexpr double kDegree = std::numbers::pi / 180.0;

/// How many numbers a key takes, and whether it may stand more than once.
struct Rule {
  std::size_t numbers = 0;
  bool repeats = false;
};
const std::map<std::string, Rule>& rules() {
  static const std::map<std::string, Rule> kRules = {
      {"box", {6}},       {"start", {3}},        {"goal", {3}},
      {"waypoints", {1}}, {"sphere", {4, true}}, {"negative_to_zero", {1}},
      {"size", {2}},      {"zlimits", {2}},      {"angle_limit_deg", {1}},
      {"weights", {4}},   {"rmin_rmax", {2}},    {"threat", {3, true}}};
  return kRules;
}

using Numbers = std::vector<double>;
struct Content {
  std::string name;
  std::string dem;
  std::map<std::string, std::vector<Numbers>> rows;

  bool has(const std::string& key) const { return rows.contains(key); }
  const Numbers& one(const std::string& key) const { return rows.at(key).front(); }
  Vec3 point(const std::string& key) const { return Vec3(one(key)[0], one(key)[1], one(key)[2]); }
};

Status read_line(const std::string& line, const std::string& at, Content& content) {
  std::istringstream words(line.substr(0, line.find('#')));
  std::string key;
  if (!(words >> key)) return {};
  if (key == "name" || key == "dem") {
    std::string& text = key == "name" ? content.name : content.dem;
    if (!text.empty() || !(words >> text)) return bad_input(at + key + " must stand once, with a word.");
    return {};
  }
  const auto rule = rules().find(key);
  if (rule == rules().end()) return bad_input(at + "the key '" + key + "' is unknown.");
  Numbers numbers;
  for (std::string word; words >> word;) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      return bad_input(at + key + " has '" + word + "', which must be a finite number.");
    }
    numbers.push_back(value);
  }
  if (numbers.size() != rule->second.numbers) {
    return bad_input(at + key + " has " + std::to_string(numbers.size()) + " numbers; it needs " +
                     std::to_string(rule->second.numbers) + ".");
  }
  auto& rows = content.rows[key];
  if (!rows.empty() && !rule->second.repeats) return bad_input(at + key + " stands twice.");
  rows.push_back(std::move(numbers));
  return {};
}

Result<Content> read_content(const std::string& path) {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  std::ifstream stream(path);
  if (error || !stream) return not_found(path + ": cannot be read.");
  if (bytes > kMaxBytes) return bad_input(path + ": is larger than 1 MB.");
  Content content;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string at = path + ":" + std::to_string(number) + ": ";
    if (Status status = read_line(line, at, content); !status) return status.error();
  }
  std::vector<std::string> needed = {"start", "goal", "waypoints"};
  if (content.dem.empty()) {
    needed.emplace_back("box");
  } else {
    needed.insert(needed.end(), {"zlimits", "angle_limit_deg", "size"});
  }
  for (const std::string& key : needed) {
    if (!content.has(key)) return bad_input(path + ": the key '" + key + "' is missing.");
  }
  const double waypoints = content.one("waypoints")[0];
  if (waypoints != std::floor(waypoints) || waypoints < 1.0 || waypoints > 64.0) {
    return bad_input(path + ": waypoints must be a whole number from 1 to 64.");
  }
  return content;
}

Scenario scenario_of(const std::string& path, const Content& content) {
  Scenario scenario;
  scenario.file = path;
  scenario.name = content.name.empty() ? fs::path(path).stem().string() : content.name;
  scenario.planning.waypoints = static_cast<int>(content.one("waypoints")[0]);
  scenario.start_m = content.point("start");
  scenario.goal_m = content.point("goal");
  return scenario;
}

Result<PublicScene> among_spheres(const std::string& path, const Content& content) {
  PublicScene scene{scenario_of(path, content), nullptr};
  Scenario& scenario = scene.scenario;
  const Numbers& box = content.one("box");
  scenario.bounds = {Vec3(box[0], box[1], box[2]), Vec3(box[3], box[4], box[5])};
  scenario.terrain = FlatTerrain{box[2] - 1.0};
  VehicleLimits& limits = scenario.vehicle.limits;
  limits = {1e-6, 0.0, 1.0, 1.0, 1.0, std::numbers::pi, 89.0 * kDegree};
  if (content.has("sphere")) {
    for (const Numbers& sphere : content.rows.at("sphere")) {
      Obstacle obstacle;
      obstacle.id = static_cast<std::uint32_t>(scenario.obstacles.size()) + 1;
      obstacle.shape = Sphere{sphere[3]};
      obstacle.position_m = Vec3(sphere[0], sphere[1], sphere[2]);
      scenario.obstacles.push_back(obstacle);
    }
  }
  auto world = World::make(Terrain::flat(box[2] - 1.0), scenario.obstacles, scenario.bounds);
  if (!world) return bad_input(path + ": " + world.error().message);
  scene.world = std::move(*world);
  return scene;
}

/// The raster with cells of a metre, sample (1, 1) the first of the file's first row.
Result<TerrainGrid> read_grid(const std::string& path, const Content& content) {
  const fs::path folder = fs::path(path).parent_path();
  fs::path file = folder / content.dem;
  if (!fs::exists(file)) file = folder / ".." / content.dem;
  RasterOptions options;
  options.no_data_elevation_m = 0.0;
  auto terrain = read_terrain(file.lexically_normal().string(), options);
  if (!terrain) return terrain.error();
  TerrainGrid grid = *terrain->grid();
  const Numbers& size = content.one("size");
  if (grid.cols != size[0] || grid.rows != size[1]) {
    return bad_input(path + ": size does not fit " + content.dem + ", which has " +
                     std::to_string(grid.cols) + " × " + std::to_string(grid.rows) + " cells.");
  }
  for (int row = 0; row < grid.rows / 2; ++row) {
    const auto south = grid.elevation_m.begin() + static_cast<std::ptrdiff_t>(row) * grid.cols;
    const auto north =
        grid.elevation_m.begin() + static_cast<std::ptrdiff_t>(grid.rows - 1 - row) * grid.cols;
    std::swap_ranges(south, south + grid.cols, north);
  }
  if (content.has("negative_to_zero") && content.one("negative_to_zero")[0] != 0.0) {
    for (float& z : grid.elevation_m) z = std::max(z, 0.0F);
  }
  grid.origin_m = Vec2(1.0, 1.0);
  grid.cell_size_m = 1.0;
  return grid;
}

Result<PublicScene> over_elevation_model(const std::string& path, const Content& content) {
  auto grid = read_grid(path, content);
  if (!grid) return grid.error();
  PublicScene scene{scenario_of(path, content), nullptr};
  Scenario& scenario = scene.scenario;
  const Numbers& height = content.one("zlimits");
  const auto [least, greatest] = std::ranges::minmax(grid->elevation_m);
  scenario.bounds = {Vec3(1.0, 1.0, least), Vec3(grid->cols, grid->rows, greatest + height[1])};
  scenario.planning.cost = content.has("weights") ? "SPSO" : "NMOPSO";
  scenario.planning.altitude_m = Vec2(height[0], height[1]);
  if (content.has("weights")) {
    const Numbers& weights = content.one("weights");
    scenario.planning.weights = {
        {"length", weights[0]}, {"threat", weights[1]}, {"altitude", weights[2]}, {"smoothness", weights[3]}};
  }
  VehicleLimits& limits = scenario.vehicle.limits;
  limits.radius_m = 1.0;
  limits.margin_m = 0.0;
  limits.turn_max_rad = limits.climb_max_rad = content.one("angle_limit_deg")[0] * kDegree;
  if (content.has("threat")) {
    for (const Numbers& threat : content.rows.at("threat")) {
      Obstacle obstacle;
      obstacle.id = static_cast<std::uint32_t>(scenario.obstacles.size()) + 1;
      obstacle.shape = Cylinder{threat[2], scenario.bounds.max_m.z() - scenario.bounds.min_m.z()};
      obstacle.position_m = Vec3(threat[0], threat[1], scenario.bounds.min_m.z());
      scenario.obstacles.push_back(obstacle);
    }
  }
  auto terrain = Terrain::from_grid(std::move(*grid));
  if (!terrain) return bad_input(path + ": " + terrain.error().message);
  for (Vec3* end : {&*scenario.start_m, &*scenario.goal_m})
    end->z() += terrain->height_at(end->x(), end->y());
  auto world = World::make(std::move(*terrain), scenario.obstacles, scenario.bounds);
  if (!world) return bad_input(path + ": " + world.error().message);
  scene.world = std::move(*world);
  return scene;
}

}  // namespace

Result<PublicScene> read_public_scene(const std::string& path) {
  auto content = read_content(path);
  if (!content) return content.error();
  return content->dem.empty() ? among_spheres(path, *content) : over_elevation_model(path, *content);
}

}  // namespace swallowtail::planner
