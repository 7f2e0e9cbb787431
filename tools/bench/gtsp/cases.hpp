#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coverage/gtsp/instance.hpp"

namespace swallowtail::bench {

struct GtspCase {
  std::string name;
  gtsp::Instance instance;
  double best_known = gtsp::kNoArc;  ///< kNoArc: none
};

/// The .gtsp files of a folder by number of vertices, with the values of best_known.csv (name,best_known,…)
/// beside them. Errors: a file that cannot be read as it should.
Result<std::vector<GtspCase>> read_gtsp_cases(const std::filesystem::path& folder);

/// Points drawn evenly over a square of side 10,000, five to a cluster: one of n/5 centres takes the nearest
/// free ones, as the clusters of [FISCHETTI-SALAZAR-TOTH] do.
GtspCase generated_gtsp_case(int vertices, std::uint64_t seed);

/// What a peer reached on a case.
struct PeerResult {
  std::string subject;
  std::string case_name;
  double gap_percent = 0.0;
  double cpu_s = 0.0;
};
/// A file under the header subject,case,gap_percent,cpu_s. Errors name file and line.
Result<std::vector<PeerResult>> read_peer_results(const std::filesystem::path& path);

}  // namespace swallowtail::bench
