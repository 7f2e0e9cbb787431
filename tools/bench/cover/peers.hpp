#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/base/result.hpp"

namespace swallowtail::bench {

/// What another planner was measured at, on another day.
struct CoverPeer {
  std::string subject;
  std::string case_name;
  std::string seconds;  ///< as written; empty: only the remark
  std::string remark;
};
/// A file under the header subject,case,seconds,remark. Errors name file and line.
Result<std::vector<CoverPeer>> read_cover_peers(const std::filesystem::path& path);

/// "39 s (remark)" of every peer that has the case; "-" when none has.
std::string peers_cell(const std::vector<CoverPeer>& peers, const std::string& case_name);

}  // namespace swallowtail::bench
