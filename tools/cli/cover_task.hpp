#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coverage/schedule/task.hpp"
#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::cli {

/// A coverage job: one task, or one for each field of a file whose fields lie too far apart.
struct CoverJob {
  std::string name;
  std::vector<coverage::Task> tasks;
  planner::Terrain terrain = planner::Terrain::flat(0.0);
};

/// The scenario's coverage over its terrain. Errors: no coverage, as fields_of and load_terrain.
Result<CoverJob> job_of(const planner::Scenario& scenario, std::uint64_t seed);

/// What a fields file needs besides itself; the defaults are a small multirotor and its ground robot.
struct FieldsJob {
  std::string file;
  std::vector<std::string> field_ids;  ///< empty: all
  coverage::Task task;                 ///< everything but fields, origin and start
  std::map<std::string, double> class_heights_m;
  std::string no_fly_file;  ///< see FieldFileOptions
  double default_height_m = 20.0;
  planner::ChargerSpec ways{};  ///< where the ground robot may drive: its `ground`
  std::optional<double> sweep_deg;
  enum class Split { kAuto, kOne, kEach } split = Split::kAuto;
};

/// Fields over flat ground. kAuto makes one mission of fields that lie within kMaxMissionExtent_m of each
/// other, else one of each. The start is the first field's first corner.
Result<CoverJob> job_of(const FieldsJob& fields);

inline constexpr double kMaxMissionExtent_m = 3000.0;

}  // namespace swallowtail::cli
