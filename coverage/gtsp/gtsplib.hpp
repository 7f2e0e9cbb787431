#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "coverage/gtsp/instance.hpp"
#include "planner/base/result.hpp"

namespace swallowtail::gtsp {

/// Reads an instance in the extended TSPLIB format [GTSPLIB]: types GTSP and AGTSP (a TSP or ATSP file
/// becomes clusters of one); EDGE_WEIGHT_TYPE EUC_2D, CEIL_2D, GEO, GEOM, ATT, or EXPLICIT as FULL_MATRIX or
/// a triangle (UPPER_ROW, LOWER_ROW, UPPER_DIAG_ROW, LOWER_DIAG_ROW and the _COL forms). Spaces around the
/// colon, or its absence, do not matter; nor do line ends and case of keys. Vertices and sets count from 1 in
/// the file, from 0 in the instance. Diagonals are ignored. Errors (kBadInput): `name:line: key: value:
/// rule`. Memory grows with what was read, never with what a header promises.
Result<Instance> read_gtsplib(std::istream& in, const std::string& name);
/// Errors: as above, or kNotFound when the file cannot be opened.
Result<Instance> read_gtsplib(const std::filesystem::path& path);

}  // namespace swallowtail::gtsp
