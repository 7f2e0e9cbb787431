#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "planner/base/result.hpp"

namespace swallowtail::gtsp {

/// A TSPLIB tour file: header lines, TOUR_SECTION, vertices counted from 1, −1. Vertices count from 0 in
/// memory. Errors (kBadInput): `name:line: key: value: rule`; at most kMaxVertices vertices are read.
Result<std::vector<int>> read_tour(std::istream& in, const std::string& name);
/// Errors: as above, or kNotFound when the file cannot be opened.
Result<std::vector<int>> read_tour(const std::filesystem::path& path);

/// Writes such a file. Errors (kInternal): the stream refuses.
Status write_tour(std::ostream& out, const std::string& name, std::span<const int> tour, double cost);

}  // namespace swallowtail::gtsp
