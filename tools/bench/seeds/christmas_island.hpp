#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"
#include "planner/cost/navigation.hpp"
#include "tools/bench/seeds/claims.hpp"
#include "tools/bench/seeds/run.hpp"

/// The public codes' scenes on real terrain of Christmas Island. The terrain is no part of this project: it
/// is looked for in the folder that SWALLOWTAIL_DATA names, else in ../shared/data beside the sources.
namespace swallowtail::bench {

inline constexpr const char* kNmopsoIsland = "nmopso_sc6";
inline constexpr const char* kSpsoIsland = "spso_demo";

/// The scene's file; nothing where it is not there.
std::optional<std::string> island_file(const std::string& name);

/// The limits that [NMOPSO] names, broken on a path from start to goal: a segment shorter than R_min, one
/// that comes nearer to a threat than it may, a place off the band of heights (looked at every half metre), a
/// turn, a climb or a change of climb beyond its limit, the last segment included. Shares no code with what
/// is judged.
int broken_limits(const planner::Terrain& terrain, const planner::NavigationSpec& spec,
                  const std::vector<Vec3>& path);

/// Rows of hypervolume, front size, members that break a limit, and CPU time: nmopso for 0.3 s, nmopso-seed
/// with the public code's own parameters, 100 particles and 500 iterations.
Result<std::vector<Row>> run_nmopso_island(const std::string& file, const SeedsSchedule& schedule,
                                           cli::Progress& progress, Report& report);
/// Rows of SPSO's cost after 0.2 s of CPU time, of every optimiser.
Result<std::vector<Row>> run_spso_island(const std::string& file, const SeedsSchedule& schedule,
                                         cli::Progress& progress, Report& report);

std::vector<Claim> island_claims(const std::string& name, const std::vector<Row>& rows);

}  // namespace swallowtail::bench
