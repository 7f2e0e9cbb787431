#include "tools/bench/plan/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/bench/plot/chart.hpp"
#include "tools/bench/plot/scene_view.hpp"

namespace swallowtail::bench {
namespace {

constexpr std::size_t kChartPoints = 60;
constexpr std::size_t kScenePaths = 3;

struct Axis {
  Effort effort;
  const char* label;
  const char* caption;
};
constexpr std::array kAxes{Axis{Effort::kTime_ms, "CPU time, ms", "by time"},
                           Axis{Effort::kEvaluations, "evaluations", "by evaluations"},
                           Axis{Effort::kIterations, "iterations", "by iteration"}};

std::vector<Curve> curves_of(const std::vector<Outcome>& outcomes, std::size_t subject) {
  std::vector<Curve> curves;
  for (const Outcome& outcome : outcomes) {
    if (outcome.subject == subject) curves.push_back(outcome.run.curve);
  }
  return curves;
}

}  // namespace

std::vector<Figure> figures_of(const PlanCase& plan_case, const std::vector<Subject>& subjects,
                               const std::vector<Outcome>& outcomes, double best_known_m) {
  std::vector<Figure> figures;
  for (const Axis& axis : kAxes) {
    Chart chart{plan_case.name + ": gap to the best known length " + axis.caption,
                axis.label,
                "gap, %",
                Scale::kLog,
                Scale::kLog,
                {}};
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      const Band band = band_of(curves_of(outcomes, i), axis.effort, kChartPoints);
      if (!band.effort.empty()) chart.series.push_back(gap_series(subjects[i].name, band, best_known_m));
    }
    if (!chart.series.empty())
      figures.push_back({chart.title + ": median and quartiles over the seeds", draw(chart)});
  }
  std::vector<ViewedPath> paths;
  for (std::size_t i = 0; i < subjects.size() && paths.size() < kScenePaths; ++i) {
    const Outcome* best = nullptr;
    for (const Outcome& outcome : outcomes) {
      if (outcome.subject == i && outcome.certified() &&
          (best == nullptr || outcome.length_m() < best->length_m()))
        best = &outcome;
    }
    if (best != nullptr) paths.push_back({subjects[i].name, best->run.path_m});
  }
  figures.push_back({plan_case.name + ": best paths", draw_scene(plan_case.name, *plan_case.world, paths)});
  return figures;
}

}  // namespace swallowtail::bench
