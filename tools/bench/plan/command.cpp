#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "tools/bench/commands.hpp"
#include "tools/bench/core/options.hpp"
#include "tools/bench/plan/figures.hpp"
#include "tools/bench/plan/invariance.hpp"
#include "tools/bench/plan/run.hpp"

namespace swallowtail::bench {
namespace {

constexpr int kRuns = 30;
constexpr int kQuickRuns = 2;
constexpr int kInvarianceRuns = 100;
constexpr double kLimit_s = 0.5;
constexpr double kQuickLimit_s = 0.01;
constexpr std::uint64_t kInvarianceEvaluations = 4000;
constexpr const char* kQuickCase = "five_spheres";

struct PlanBench {
  Options options;
  std::vector<std::string> cases;
  std::vector<std::string> only;
  bool no_peers = false;
  bool invariance = false;
  bool ablation = false;
  bool update_best = false;
};

std::string best_known_path(const Options& options) { return options.data + "/best_known.csv"; }

/// Those that were asked for by name; all when none was. Errors: a name that nobody has.
Result<std::vector<Subject>> chosen(std::vector<Subject> subjects, const std::vector<std::string>& only) {
  if (only.empty()) return subjects;
  std::vector<Subject> kept;
  std::string known;
  for (const Subject& subject : subjects) known += (known.empty() ? "" : ", ") + subject.name;
  for (const std::string& name : only) {
    const auto found = std::ranges::find(subjects, name, &Subject::name);
    if (found == subjects.end())
      return bad_input(fmt::format("There is no subject '{}'; known are: {}.", name, known));
    kept.push_back(*found);
  }
  return kept;
}

Result<std::vector<Subject>> subjects_of(const PlanBench& bench, Report& report) {
  std::vector<Subject> subjects = bench.ablation ? ablation_subjects() : our_subjects();
  if (!bench.no_peers && !bench.ablation && !bench.invariance) {
    std::vector<std::string> missing;
    for (Subject& peer : peer_subjects(missing)) subjects.push_back(std::move(peer));
    for (std::string& sentence : missing) report.notes.push_back(std::move(sentence));
  }
  return chosen(std::move(subjects), bench.only);
}

Schedule schedule_of(const PlanBench& bench) {
  Schedule schedule;
  schedule.first_seed = bench.options.common.seed;
  schedule.runs = runs_of(bench.options, kRuns, kQuickRuns);
  schedule.limit.cpu_s = time_limit_of(bench.options, kLimit_s, kQuickLimit_s);
  schedule.threads = bench.options.common.threads;
  return schedule;
}

/// Why paths did not count, one sentence for each subject.
void note_failures(const PlanCase& plan_case, const std::vector<Subject>& subjects,
                   const std::vector<Outcome>& outcomes, std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    std::size_t refused = 0;
    std::string why;
    for (const Outcome& outcome : outcomes) {
      if (outcome.subject != i) continue;
      if (!outcome.run.failure.empty()) why = "could not be run: " + outcome.run.failure;
      if (outcome.refusal.empty()) continue;
      ++refused;
      why = fmt::format("the certifier refused {} of its paths: {}", refused, outcome.refusal);
    }
    if (!why.empty()) notes.push_back(fmt::format("{}, {}: {}", plan_case.name, subjects[i].name, why));
  }
}

/// The best known length after these runs; an improvement is noted and taken into the file's contents.
double settle_best(const PlanCase& plan_case, const std::vector<Subject>& subjects,
                   const std::vector<Outcome>& outcomes, BestKnownFile& file, Report& report) {
  const double found_m = shortest_m(outcomes);
  const auto known = file.find(plan_case.name, "length");
  std::string by;
  for (const Outcome& outcome : outcomes) {
    if (outcome.length_m() == found_m)
      by = fmt::format("{}, seed {}", subjects[outcome.subject].name, outcome.seed);
  }
  if (file.improve({plan_case.name, "length", found_m, "m", "swallowtail bench plan: " + by})) {
    const std::string note =
        known ? fmt::format("improved: {} from {:.9f} to {:.9f} m by {}", plan_case.name, known->value,
                            found_m, by)
              : fmt::format("first known length of {}: {:.9f} m by {}", plan_case.name, found_m, by);
    report.notes.push_back(note);
    report.extra["improved"].push_back({{"case", plan_case.name}, {"value", found_m}, {"by", by}});
  }
  const auto best = file.find(plan_case.name, "length");
  return best ? best->value : plan_case.distance_m();
}

Status run_cases(const PlanBench& bench, const std::vector<Subject>& subjects, BestKnownFile& file,
                 Report& report) {
  std::vector<std::string> names = bench.cases;
  if (names.empty())
    names = bench.options.quick ? std::vector<std::string>{kQuickCase} : default_cases(bench.options.data);
  cli::Progress progress("bench plan",
                         bench.options.common.quiet ? cli::Progress::Show::kNo : cli::Progress::Show::kYes);
  for (const std::string& name : names) {
    if (cli::interrupted()) break;
    const auto plan_case = case_by_name(name, bench.options.data);
    if (!plan_case) return plan_case.error();
    const auto outcomes = run_case(*plan_case, subjects, schedule_of(bench), progress);
    const double best_m = settle_best(*plan_case, subjects, outcomes, file, report);
    const std::vector<Row> rows = rows_of(*plan_case, subjects, outcomes, best_m);
    report.rows.insert(report.rows.end(), rows.begin(), rows.end());
    report.tables.push_back(table_of(*plan_case, subjects, rows, best_m));
    note_failures(*plan_case, subjects, outcomes, report.notes);
    for (Figure& figure : figures_of(*plan_case, subjects, outcomes, best_m))
      report.figures.push_back(std::move(figure));
  }
  return {};
}

cli::Exit run_invariance(const PlanBench& bench, const std::vector<Subject>& subjects, Report report) {
  std::vector<Subject> forms;
  for (const Subject& subject : subjects) {
    const bool as_published = subject.name.ends_with("-seed");
    if ((subject.kind == "planner" || subject.kind == "optimiser") && !as_published) forms.push_back(subject);
  }
  Schedule schedule = schedule_of(bench);
  schedule.runs = runs_of(bench.options, kInvarianceRuns, kQuickRuns);
  schedule.limit = {};
  schedule.limit.evaluations = kInvarianceEvaluations;
  Invariance invariance;
  {
    cli::Progress progress("bench plan",
                           bench.options.common.quiet ? cli::Progress::Show::kNo : cli::Progress::Show::kYes);
    invariance = measure_invariance(forms, schedule, progress);
  }
  report.rows = std::move(invariance.rows);
  report.tables.push_back(std::move(invariance.table));
  report.extra["invariant"] = invariance.all_hold;
  return deliver(bench.options, std::move(report));
}

cli::Exit run_bench(const PlanBench& bench) {
  if (const Status status = check(bench.options); !status) return cli::fail(status.error());
  Report report;
  report.bench = "plan";
  report.extra["improved"] = nlohmann::ordered_json::array();
  const auto subjects = subjects_of(bench, report);
  if (!subjects) return cli::fail(subjects.error());
  if (bench.invariance) return run_invariance(bench, *subjects, std::move(report));
  auto file = BestKnownFile::read(best_known_path(bench.options));
  if (!file) return cli::fail(file.error());
  if (const Status status = run_cases(bench, *subjects, *file, report); !status)
    return cli::fail(status.error());
  report.notes.push_back(
      fmt::format("Times are CPU time of the thread; every path counted was certified with the climb limit "
                  "open for all. OMPL's "
                  "evaluations are motions checked; each run ends after {} s.",
                  schedule_of(bench).limit.cpu_s));
  if (bench.update_best) {
    if (const Status status = cli::write_text(best_known_path(bench.options), file->text()); !status)
      return cli::fail(status.error());
  }
  return deliver(bench.options, std::move(report));
}

}  // namespace

void add_plan(CLI::App& app, cli::Exit& exit) {
  CLI::App* command =
      app.add_subcommand("plan", "Our planner and optimisers beside OMPL and pagmo in the same worlds");
  const auto bench = std::make_shared<PlanBench>();
  command->add_option("SCENARIO", bench->cases,
                      "Names of shipped scenes, big_world, or scenario files; none: all that are shipped");
  command->add_option("--only", bench->only, "Subjects by name, as the table has them")->delimiter(',');
  command->add_flag("--no-peers", bench->no_peers, "Ours only");
  command->add_flag("--invariance", bench->invariance,
                    "Instead: whether results change when the scene is shifted, turned and scaled");
  command->add_flag("--ablation", bench->ablation,
                    "Instead: plan_path whole and without one of its parts at a time");
  command->add_flag("--update-best", bench->update_best,
                    "Write improved best known values to the data folder");
  add_options(*command, bench->options,
              "  swallowtail bench plan five_spheres --runs 30\n"
              "  swallowtail bench plan --quick --json\n"
              "  swallowtail bench plan my_scene.yaml --only plan_path,\"ompl InformedRRT*\" --time-limit 1 "
              "-o bench.html\n"
              "  swallowtail bench plan --invariance");
  command->callback([bench, &exit] { exit = run_bench(*bench); });
}

}  // namespace swallowtail::bench
