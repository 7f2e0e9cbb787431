#include "tools/bench/plan/subject.hpp"

#include <utility>

#ifdef SWALLOWTAIL_WITH_OMPL
#include "tools/bench/plan/peer_ompl.hpp"
#endif
#ifdef SWALLOWTAIL_WITH_PAGMO
#include "tools/bench/plan/peer_pagmo.hpp"
#endif

namespace swallowtail::bench {

void Recorder::offer(std::span<const Vec3> path, double length_m, std::uint64_t evaluations,
                     std::uint64_t iterations) {
  if (length_m >= best_length_m_) return;
  best_length_m_ = length_m;
  run_.path_m.assign(path.begin(), path.end());
  run_.curve.push_back({cpu_ms(), evaluations, iterations, length_m});
}

PlanRun Recorder::finish(std::uint64_t evaluations) {
  run_.cpu_ms = cpu_ms();
  run_.evaluations = evaluations;
  return std::move(run_);
}

std::vector<Subject> peer_subjects(std::vector<std::string>& notes) {
  std::vector<Subject> subjects;
  const auto add = [&subjects](std::vector<Subject> more) {
    for (Subject& subject : more) subjects.push_back(std::move(subject));
  };
#ifdef SWALLOWTAIL_WITH_OMPL
  add(ompl_subjects());
  notes.emplace_back("OMPL " SWALLOWTAIL_OMPL_VERSION ", default parameters, exact motion validator.");
#else
  notes.emplace_back(
      "OMPL (RRTConnect, RRT*, InformedRRT*, BIT*, ABIT*): not built, libompl-dev was not there.");
#endif
#ifdef SWALLOWTAIL_WITH_PAGMO
  add(pagmo_subjects());
  notes.emplace_back("pagmo " SWALLOWTAIL_PAGMO_VERSION ", default parameters, 200 individuals.");
#else
  notes.emplace_back("pagmo (pso, bee_colony, gaco, cmaes, nspso): not built, libpagmo-dev was not there.");
#endif
  (void)add;
  return subjects;
}

}  // namespace swallowtail::bench
