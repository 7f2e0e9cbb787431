#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "coverage/field/sub_cells.hpp"
#include "planner/base/result.hpp"

/// Ground for the experiments of [COV 5]: strips, and heights drawn for them, since the document's own are
/// figures only.
namespace swallowtail::bench {

/// A cell of [COV 3]: the ends of a strip's centre line, on flat ground.
struct StripLine {
  Vec2 alpha_m = Vec2::Zero();
  Vec2 beta_m = Vec2::Zero();
};

/// Strips of every polygon of a field file, flown eastwards. Errors: see coverage::read_fields; a polygon
/// that cannot be cut.
Result<std::vector<StripLine>> strips_of_fields(const std::string& path, double sensor_width_m);

/// A file of the document's parent: `x1 y1 ugv1 x2 y2 ugv2` a line; whether the ground robot can reach a site
/// is left aside, as in [COV]. Errors name file and line.
Result<std::vector<StripLine>> read_strips(const std::string& path);

/// The parent's files yu_sites/NAME.txt; nothing where the real data are not there (SWALLOWTAIL_DATA, else
/// ../shared/data beside the sources).
std::optional<std::string> parents_file(const std::string& name);

/// Every strip whole and at one height.
std::vector<coverage::SubCell> level_cells(const std::vector<StripLine>& strips, double height_m);
/// Heights of 2, 4, … 10 drawn for each strip; half of the strips change theirs somewhere in their middle
/// third and are two sub-cells there.
std::vector<coverage::SubCell> drawn_cells(const std::vector<StripLine>& strips, std::uint64_t seed);

/// [COV 5.3]'s M: the greatest |α − β| + h.
double longest_m(const std::vector<coverage::SubCell>& cells);

}  // namespace swallowtail::bench
