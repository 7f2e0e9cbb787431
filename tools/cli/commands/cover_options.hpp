#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "coverage/fleet/fleet.hpp"
#include "tools/cli/common.hpp"
#include "tools/cli/cover_task.hpp"

namespace swallowtail::cli {

struct CoverOptions {
  Common common;
  std::string file;
  FieldsJob fields;
  gtsp::Mode mode = gtsp::Mode::kFast;
  double time_limit_s = 0.0;
  bool compare_full_graph = false;
  coverage::FleetOptions fleet;
  bool has_sensor_width = false;
  std::vector<std::string> class_heights;  ///< NAME=METRES
  bool is_multirotor = false;
  coverage::Multirotor craft;
  double wind_mps = 0.0;
  double wind_to_deg = 0.0;
  planner::RoadSpec roads;
  planner::RoughGroundSpec rough;
  std::optional<double> slope_max_deg;
  std::vector<std::string> starts;  ///< EAST,NORTH
};

void add_fleet_options(CLI::App& command, CoverOptions& options);
/// For a fields file.
void add_fields_options(CLI::App& command, CoverOptions& options);

/// Energy model, class heights and the ground robot's ways, as far as they are put together from several
/// options.
Status complete(CoverOptions& options);
/// The starts given, for the one mission; without a number of aircraft there is one for each.
Status set_starts(CoverOptions& options, CoverJob& job);

}  // namespace swallowtail::cli
