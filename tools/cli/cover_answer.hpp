#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coverage/schedule/plan.hpp"
#include "tools/cli/cover_task.hpp"
#include "tools/cli/output.hpp"

namespace swallowtail::cli {

/// What became of one task.
struct Covered {
  const coverage::Task* task = nullptr;
  std::optional<coverage::Plan> plan;
  std::string reason;  ///< why there is no plan
  double wall_s = 0.0;
  std::vector<coverage::FieldReport> fields{};  ///< without a plan: how each field was cut or why refused
};

enum class CoverStatus { kCertified, kPartial, kInfeasible, kInterrupted };
const char* name(CoverStatus status);

/// Certified only when every task has a complete plan.
CoverStatus status_of(const std::vector<Covered>& done);

/// The document, table and files (csv of legs, geojson of legs, transfers and rendezvous, and those of
/// cover_files.hpp) of `cover`. Figures of several tasks are added up, least energies and percentages taken
/// over all. The .plan is empty where cover_qgc_plan refuses. Borrows `job` and `done`.
Answer answer_of(const CoverJob& job, const std::vector<Covered>& done, CoverStatus status, double wall_s);

}  // namespace swallowtail::cli
