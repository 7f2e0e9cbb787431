#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coverage/schedule/plan.hpp"
#include "tools/cli/cover_task.hpp"
#include "tools/cli/output.hpp"

namespace swallowtail::cli {

/// What became of one task, or of one aircraft's part of it: those of a task follow each other.
struct Covered {
  const coverage::Task* task = nullptr;
  std::optional<coverage::Plan> plan;
  std::string reason;  ///< why there is no plan
  double wall_s = 0.0;
  std::vector<coverage::FieldReport> fields{};  ///< without a plan: how each field was cut or why refused
  int aircraft = 0;                             ///< of several for a task, from 1 on; 0: there is one
  double delay_s = 0.0;                         ///< waited on the ground for the others
  double alone_s = 0.0;                         ///< the task's makespan with one aircraft
  std::shared_ptr<const coverage::Task> own_task{};  ///< an aircraft's; `task` points to it
};

enum class CoverStatus { kCertified, kPartial, kInfeasible, kInterrupted };
const char* name(CoverStatus status);

/// Certified only when every task has a complete plan.
CoverStatus status_of(const std::vector<Covered>& done);

/// The document, table and files (csv of legs, geojson of legs, transfers and rendezvous, and those of
/// cover_files.hpp; .plan one for each of several aircraft) of `cover`. Figures of several tasks are added
/// up, least energies and percentages taken over all. The .plan is empty where cover_qgc_plan refuses.
/// Borrows `job` and `done`.
Answer answer_of(const CoverJob& job, const std::vector<Covered>& done, CoverStatus status, double wall_s);

}  // namespace swallowtail::cli
