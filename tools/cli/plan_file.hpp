#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "planner/path/certifier.hpp"
#include "planner/path/path.hpp"
#include "planner/replan/front_plan.hpp"
#include "planner/world/raster_file.hpp"

namespace swallowtail::cli {

const char* name(planner::Phase phase);

/// The document of `plan`: status, figures, waypoints with times and phases; the cost by its preset's terms,
/// of the path or, where none is certified, of `attempt_m`.
nlohmann::ordered_json to_json(const planner::PricedReport& report, const std::string& scenario,
                               const planner::PricedRequest& request);
/// Members `front` [{objectives {F1 … F4}, waypoints_m, certified}], `hypervolume`, and as indices of members
/// `picked`, the compromise, and `flown`, which the plan is; null where there is none.
nlohmann::ordered_json to_json(const planner::PlannedFront& front);
nlohmann::ordered_json to_json(const planner::Violation& violation);
nlohmann::ordered_json to_json(const Vec3& point);

/// The timed path in such a document, wherever it was made; nothing in it is trusted. Errors (kBadInput) name
/// the file, the place in it and the rule.
Result<planner::TimedPath> read_plan(const std::string& path);
Result<planner::TimedPath> parse_plan(const std::string& text, const std::string& name);

std::string path_csv(const planner::TimedPath& path);
/// A member a line: its index, F1 to F4, whether it is certified, picked and flown (1 or 0), its places as
/// "x y z;x y z".
std::string front_csv(const planner::PlannedFront& front);
/// One LineString with elevations; longitude and latitude around `origin`, local metres without one.
std::string path_geojson(const planner::TimedPath& path, const std::optional<planner::GeoOrigin>& origin);

}  // namespace swallowtail::cli
