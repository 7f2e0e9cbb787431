#include "planner/scenario/read.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "planner/scenario/detail/raw_tree.hpp"
#include "planner/scenario/detail/read_parts.hpp"
#include "planner/scenario/detail/section.hpp"

namespace swallowtail::planner {
namespace {

using detail::Need;
using Kind = ScenarioError::Kind;

constexpr std::uintmax_t kMaxFileBytes = 8u << 20u;
constexpr int kVersion = 1;

void read_place(detail::Section& top, const char* key, std::optional<Vec3>& out) {
  Vec3 value = Vec3::Zero();
  if (top.vector(key, Need::kOptional, detail::from_to(-detail::kMaxXy_m, detail::kMaxXy_m), value))
    out = value;
}

void check_places(detail::Section& top, const Scenario& scenario) {
  if (top.has("goal_m") && !top.has("start_m")) top.fail(Kind::kRelation, "goal_m", "needs start_m");
  if (!top.has("goal_m") && !top.has("coverage"))
    top.fail(Kind::kRelation, "", "must have goal_m or coverage");
  const char* const rule = "must be within bounds_m";
  if (scenario.start_m && !scenario.bounds.contains(*scenario.start_m))
    top.fail(Kind::kRelation, "start_m", rule);
  if (scenario.goal_m && !scenario.bounds.contains(*scenario.goal_m))
    top.fail(Kind::kRelation, "goal_m", rule);
}

void read_all(detail::Section& top, const std::string& folder, Scenario& scenario) {
  int version = kVersion;
  top.integer("swallowtail", Need::kRequired, detail::from_to(kVersion, kVersion), version);
  top.text("name", Need::kRequired, scenario.name);
  detail::read_frame(top, scenario);
  detail::read_bounds(top, scenario);
  detail::read_terrain_spec(top, folder, scenario);
  detail::read_obstacles(top, scenario);
  detail::read_vehicle(top, scenario);
  read_place(top, "start_m", scenario.start_m);
  read_place(top, "goal_m", scenario.goal_m);
  detail::read_planning(top, scenario);
  detail::read_coverage(top, folder, scenario);
  detail::read_disturbances(top, scenario);
  detail::read_events(top, scenario);
  check_places(top, scenario);
  top.finish();
}

ScenarioErrors unreadable(const std::string& path, std::string rule) {
  return {{{Kind::kFile, path, 0, "", "", std::move(rule)}}};
}

}  // namespace

ScenarioResult parse_scenario(const std::string& text, const std::string& file, const std::string& folder) {
  const detail::RawTree tree = detail::parse_raw_tree(text);
  if (!tree.ok)
    return ScenarioErrors{{{Kind::kSyntax, file, std::max(tree.error_line, 1), "", "", tree.error}}};
  detail::ErrorLog log(file);
  Scenario scenario;
  scenario.file = file;
  detail::Section top(tree.root, "", log);
  if (top.is_map()) {
    read_all(top, folder, scenario);
  }
  if (!log.empty()) return log.take();
  return scenario;
}

ScenarioResult read_scenario(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return unreadable(path, "no such file");
  if (const auto size = std::filesystem::file_size(path, error); error || size > kMaxFileBytes)
    return unreadable(path, "must be at most 8 MB");
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream.good() && !stream.eof()) return unreadable(path, "cannot be read");
  const std::filesystem::path folder = std::filesystem::absolute(path, error).parent_path();
  return parse_scenario(text.str(), path, folder.string());
}

}  // namespace swallowtail::planner
