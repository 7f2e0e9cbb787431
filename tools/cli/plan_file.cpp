#include "tools/cli/plan_file.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "planner/base/checks.hpp"
#include "tools/cli/geojson.hpp"
#include "tools/cli/output.hpp"

namespace swallowtail::cli {
namespace {

using planner::Phase;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kMaxFileBytes = 64u << 20u;
constexpr std::size_t kMaxWaypoints = 1'000'000;
constexpr std::array kPhases = {std::pair{Phase::kTakeOff, "take_off"},
                                std::pair{Phase::kTransfer, "transfer"}, std::pair{Phase::kCover, "cover"},
                                std::pair{Phase::kHold, "hold"}, std::pair{Phase::kLanding, "landing"}};

std::optional<Phase> phase_of(const std::string& text) {
  for (const auto& [phase, word] : kPhases) {
    if (text == word) return phase;
  }
  return std::nullopt;
}

/// A number at `key`, NaN when there is none.
double number_at(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? json[key].get<double>() : std::nan("");
}

Result<planner::TimedWaypoint> parse_waypoint(const Json& json, const std::string& at) {
  planner::TimedWaypoint waypoint;
  if (!json.is_object()) return bad_input(at + ": must be an object.");
  waypoint.time_s = number_at(json, "time_s");
  if (!std::isfinite(waypoint.time_s)) return bad_input(at + ".time_s: must be a finite number.");
  const auto position = json.find("position_m");
  if (position == json.end() || !position->is_array() || position->size() != 3)
    return bad_input(at + ".position_m: must be [x, y, z].");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(*position)[axis].is_number()) return bad_input(at + ".position_m: must be three numbers.");
    waypoint.position_m[static_cast<Eigen::Index>(axis)] = (*position)[axis].get<double>();
  }
  if (!is_finite(waypoint.position_m)) return bad_input(at + ".position_m: must be finite.");
  if (json.contains("phase")) {
    const auto phase = json["phase"].is_string() ? phase_of(json["phase"].get<std::string>()) : std::nullopt;
    if (!phase) return bad_input(at + ".phase: must be one of take_off, transfer, cover, hold, landing.");
    waypoint.phase = *phase;
  }
  if (json.contains("leg_index")) {
    const Json& leg = json["leg_index"];
    if (!leg.is_number_unsigned() || leg.get<std::uint64_t>() > 0xffffffffu)
      return bad_input(at + ".leg_index: must be a whole number of at least 0.");
    waypoint.leg_index = leg.get<std::uint32_t>();
  }
  return waypoint;
}

Json history_json(const std::vector<planner::PlanProgress>& history) {
  Json out = Json::array();
  for (const auto& entry : history) {
    out.push_back({{"evaluations", entry.evaluations},
                   {"wall_ms", entry.wall_ms},
                   {"best_length_m", entry.best_length_m}});
  }
  return out;
}

/// Weighted terms by name, which sum up to the total, and each with its weight and value.
Json cost_json(const planner::PricedReport& report, const planner::PricedRequest& request) {
  Json cost = {{"total", report.terms.terms.empty() ? report.plan.cost : report.terms.total}};
  Json terms = Json::array();
  for (const planner::CostTerm& term : report.terms.terms) {
    cost[term.name] = term.weight * term.value;
    terms.push_back({{"name", term.name}, {"weight", term.weight}, {"value", term.value}});
  }
  if (cost.contains("violation")) cost["penalty"] = cost["violation"];
  cost["preset"] = request.cost.preset;
  cost["terms"] = std::move(terms);
  return cost;
}

}  // namespace

const char* name(Phase phase) {
  for (const auto& [value, word] : kPhases) {
    if (value == phase) return word;
  }
  return "unknown";
}

Json to_json(const Vec3& point) { return {point.x(), point.y(), point.z()}; }

Json to_json(const planner::Violation& violation) {
  return {{"time_s", violation.time_s},
          {"kind", planner::name(violation.kind)},
          {"where_m", to_json(violation.where_m)},
          {"by", violation.obstacle_id},
          {"segment", violation.segment},
          {"detail", violation.detail}};
}

Json to_json(const planner::PricedReport& priced, const std::string& scenario,
             const planner::PricedRequest& asked) {
  const planner::PlanReport& report = priced.plan;
  const planner::PlanRequest& request = asked.plan;
  Json places = Json::array();
  Json waypoints = Json::array();
  for (const auto& waypoint : report.path) {
    if (places.empty() || places.back() != to_json(waypoint.position_m))
      places.push_back(to_json(waypoint.position_m));
    waypoints.push_back({{"time_s", waypoint.time_s},
                         {"position_m", to_json(waypoint.position_m)},
                         {"phase", name(waypoint.phase)},
                         {"leg_index", waypoint.leg_index}});
  }
  Json out;
  out["scenario"] = scenario;
  out["status"] = planner::name(report.status);
  out["reason"] = report.reason;
  out["algorithm"] = request.params.algorithm;
  out["seed"] = request.seed;
  out["waypoints_m"] = std::move(places);
  out["waypoints"] = std::move(waypoints);
  out["length_m"] = report.length_m;
  out["duration_s"] = report.duration_s;
  out["clearance_min_m"] = report.certificate.clearance_min_m;
  out["cost"] = cost_json(priced, asked);
  if (!priced.attempt.empty()) {
    out["attempt_m"] = Json::array();
    for (const Vec3& point : priced.attempt) out["attempt_m"].push_back(to_json(point));
  }
  out["evaluations"] = report.evaluations;
  out["wall_ms"] = report.wall_ms;
  out["first_certified_ms"] = report.first_certified_ms;
  out["history"] = history_json(report.history);
  return out;
}

Json to_json(const planner::PlannedFront& front) {
  const auto index = [](const std::optional<std::size_t>& at) { return at ? Json(*at) : Json(nullptr); };
  Json members = Json::array();
  for (const planner::FrontMember& member : front.members) {
    Json objectives = Json::object();
    for (int k = 0; k < 4; ++k) objectives[fmt::format("F{}", k + 1)] = member.objectives[k];
    Json places = Json::array();
    for (const Vec3& point : member.polyline) places.push_back(to_json(point));
    members.push_back({{"objectives", std::move(objectives)},
                       {"waypoints_m", std::move(places)},
                       {"certified", member.certified}});
  }
  return {{"front", std::move(members)},
          {"hypervolume", front.hypervolume},
          {"picked", index(front.picked)},
          {"flown", index(front.flown)}};
}

Result<planner::TimedPath> parse_plan(const std::string& text, const std::string& file) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return bad_input(file + ": must be JSON.");
  if (!json.is_object() || !json.contains("waypoints") || !json["waypoints"].is_array()) {
    return bad_input(file + ": waypoints: must be a list, as `swallowtail plan` writes it.");
  }
  const Json& waypoints = json["waypoints"];
  if (waypoints.empty() || waypoints.size() > kMaxWaypoints) {
    return bad_input(fmt::format("{}: waypoints: must be 1 to {} of them, there are {}.", file, kMaxWaypoints,
                                 waypoints.size()));
  }
  planner::TimedPath path;
  path.reserve(waypoints.size());
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    auto waypoint = parse_waypoint(waypoints[i], fmt::format("{}: waypoints[{}]", file, i));
    if (!waypoint) return waypoint.error();
    path.push_back(*waypoint);
  }
  return path;
}

Result<planner::TimedPath> read_plan(const std::string& path) {
  auto text = read_text(path, kMaxFileBytes);
  if (!text) return text.error();
  return parse_plan(*text, path);
}

std::string path_csv(const planner::TimedPath& path) {
  std::string out = "time_s,x_m,y_m,z_m,phase,leg_index\n";
  for (const auto& w : path) {
    out += fmt::format("{},{},{},{},{},{}\n", w.time_s, w.position_m.x(), w.position_m.y(), w.position_m.z(),
                       name(w.phase), w.leg_index);
  }
  return out;
}

std::string front_csv(const planner::PlannedFront& front) {
  std::string out = "index,F1,F2,F3,F4,certified,picked,flown,waypoints_m\n";
  for (std::size_t i = 0; i < front.members.size(); ++i) {
    const planner::FrontMember& member = front.members[i];
    const Eigen::Vector4d& f = member.objectives;
    out += fmt::format("{},{},{},{},{},{:d},{:d},{:d},", i, f[0], f[1], f[2], f[3], member.certified,
                       front.picked == i, front.flown == i);
    for (std::size_t k = 0; k < member.polyline.size(); ++k) {
      const Vec3& p = member.polyline[k];
      out += fmt::format("{}{} {} {}", k > 0 ? ";" : "", p.x(), p.y(), p.z());
    }
    out += "\n";
  }
  return out;
}

std::string path_geojson(const planner::TimedPath& path, const std::optional<planner::GeoOrigin>& origin) {
  GeoJsonWriter writer(origin);
  std::vector<Vec3> points;
  for (const auto& waypoint : path) points.push_back(waypoint.position_m);
  writer.add_line(points, {{"kind", "path"},
                           {"start_s", path.empty() ? 0.0 : path.front().time_s},
                           {"end_s", path.empty() ? 0.0 : path.back().time_s}});
  return writer.text();
}

}  // namespace swallowtail::cli
