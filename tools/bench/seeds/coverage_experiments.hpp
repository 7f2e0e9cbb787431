#pragma once

#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "tools/bench/core/report.hpp"
#include "tools/bench/core/row.hpp"
#include "tools/bench/seeds/claims.hpp"
#include "tools/bench/seeds/run.hpp"
#include "tools/cli/progress.hpp"

/// The experiments of [COV 5] by its own method (LayeredGraph and its tour), on polygons of ours and on
/// strips of the document's parent where they are there: its own polygons are figures only.
namespace swallowtail::bench {

inline constexpr const char* kCovHeights = "cov_heights";         ///< [COV 5.1]
inline constexpr const char* kCovSafeHeight = "cov_safe_height";  ///< [COV 5.2]
inline constexpr const char* kCovBattery = "cov_battery";         ///< [COV 5.3]
inline constexpr const char* kCovLevels = "cov_levels";           ///< [COV 5.4]
inline constexpr const char* kCovNeighbours = "cov_neighbours";   ///< [COV 5.5]
const std::vector<std::string>& coverage_experiments();

/// D_max in units of M, in the order of the sweep.
const std::vector<double>& battery_sweep();
/// Values of k, in the order of the sweep.
const std::vector<int>& level_sweep();
/// The subject of a row: "with heights, D_max = 1.20 M", "without heights, k = 10".
std::string battery_subject(const std::string& heights, double units_of_m);
std::string level_subject(const std::string& heights, int levels);

/// Rows of cost, cpu, vertices, recharges, height_changes, scheduled_cost and covered (percent at the right
/// height) by ground, which is the row's case ("cov_levels, fields"), subject and seed; heights are drawn by
/// the seed. A table and figures are added to `report`. `data` is the folder that has
/// seeds/cov_fields.geojson. Ends early when interrupted.
Result<std::vector<Row>> run_coverage_experiment(const std::string& name, const std::string& data,
                                                 const SeedsSchedule& schedule, cli::Progress& progress,
                                                 Report& report);

/// What [COV 5] prints of the experiment, for each ground that has rows.
std::vector<Claim> coverage_claims(const std::string& name, const std::vector<Row>& rows);

}  // namespace swallowtail::bench
