#include <algorithm>
#include <atomic>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "coverage/fleet/fleet.hpp"
#include "planner/base/clock.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/commands/cover_options.hpp"
#include "tools/cli/cover_answer.hpp"
#include "tools/cli/cover_files.hpp"
#include "tools/cli/cover_run.hpp"
#include "tools/cli/cover_task.hpp"
#include "tools/cli/input.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/drawing/png.hpp"

namespace swallowtail::cli {
namespace {

coverage::PlanOptions plan_options(const CoverOptions& options, const Clock& clock, double deadline_s,
                                   int threads) {
  coverage::PlanOptions out;
  out.seed = options.common.seed;
  out.mode = options.mode;
  out.clock = &clock;
  out.stop.clock = &clock;
  out.stop.deadline_s = deadline_s;
  out.stop.stop_requested = &interrupted();
  out.full_graph = options.compare_full_graph ? coverage::FullGraph::kCompare : coverage::FullGraph::kSkip;
  out.threads = threads;
  return out;
}

/// Several tasks are shared out over the threads, a single one gets them all. The same answer for any number
/// of threads.
std::vector<Covered> cover_all(const CoverOptions& options, const CoverJob& job, const Clock& clock,
                               Progress& progress) {
  const double deadline_s = options.time_limit_s > 0.0 ? clock.now_s() + options.time_limit_s
                                                       : std::numeric_limits<double>::infinity();
  const auto count = static_cast<int>(job.tasks.size());
  const auto plan = plan_options(options, clock, deadline_s, count == 1 ? options.common.threads : 1);
  std::vector<std::vector<Covered>> by_task(job.tasks.size());
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) {
      const auto at = static_cast<std::size_t>(i);
      if (interrupted()) {
        by_task[at].emplace_back();
        by_task[at].back().task = &job.tasks[at];
        by_task[at].back().reason = "Interrupted before this field was planned.";
        continue;
      }
      by_task[at] = cover_task(job.tasks[at], job.terrain, plan, options.fleet);
      progress.update(fmt::format("{} of {} tasks", i + 1, count));
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < std::min(options.common.threads, count); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  std::vector<Covered> done;
  for (std::vector<Covered>& parts : by_task) std::ranges::move(parts, std::back_inserter(done));
  return done;
}

bool is_scenario(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  return extension == ".yaml" || extension == ".yml";
}

std::optional<CoverJob> read_job(CoverOptions& options, Exit& exit) {
  exit = Exit::kUsage;
  auto job = [&]() -> std::optional<Result<CoverJob>> {
    if (is_scenario(options.file)) {
      const auto scenario = read_scenario_or_tell(options.file);
      if (!scenario) return std::nullopt;
      return job_of(*scenario, options.common.seed);
    }
    if (!options.has_sensor_width) return bad_input("cover: a fields file needs --sensor-width.");
    if (const Status status = complete(options); !status) return status.error();
    options.fields.file = options.file;
    options.fields.task.seed = options.common.seed;
    const coverage::FieldRules& rules = options.fields.task.rules;
    if (rules.headland != coverage::Headland::kNone && rules.headland_m <= 0.0)
      return bad_input("cover: --headland needs --headland-width.");
    return job_of(options.fields);
  }();
  if (!job) return std::nullopt;
  if (!*job) {
    exit = fail(job->error());
    return std::nullopt;
  }
  if (const Status status = set_starts(options, job->value()); !status) {
    exit = fail(status.error());
    return std::nullopt;
  }
  return std::move(job->value());
}

/// Tells before any work is done that a .plan cannot hold the answer.
Status check_plan_file(const std::string& output, const CoverJob& job) {
  if (std::filesystem::path(output).extension() != ".plan") return {};
  std::vector<Covered> unplanned;
  for (const coverage::Task& task : job.tasks) unplanned.push_back({&task, coverage::Plan(), "", 0.0});
  if (unplanned.size() == 1 && unplanned.front().task->origin) return {};
  const auto refused = cover_qgc_plan(unplanned);
  return refused ? Status() : Status(refused.error());
}

Exit run_cover(CoverOptions& options) {
  const Status output =
      check_output(options.common, {".json", ".csv", ".geojson", ".kml", ".plan", ".png", ".svg"});
  if (!output.ok()) return fail(output.error());
  if (std::filesystem::path(options.common.output).extension() == ".png" && !drawing::can_draw_png())
    return fail(bad_input("-o " + options.common.output +
                          ": a PNG needs the program rsvg-convert (Debian: librsvg2-bin); .svg needs none."));
  Exit exit = Exit::kDone;
  const auto job = read_job(options, exit);
  if (!job) return exit;
  for (const coverage::Task& task : job->tasks) {
    if (const Status status = coverage::validate(task); !status.ok()) return fail(status.error());
  }
  if (const Status status = check_plan_file(options.common.output, *job); !status.ok())
    return fail(status.error());
  const SteadyClock clock;
  const double begin_s = clock.now_s();
  std::vector<Covered> done;
  {
    Progress progress("cover", options.common.quiet ? Progress::Show::kNo : Progress::Show::kYes);
    done = cover_all(options, *job, clock, progress);
  }
  const CoverStatus status = interrupted() ? CoverStatus::kInterrupted : status_of(done);
  const std::map<CoverStatus, Exit> exits = {{CoverStatus::kCertified, Exit::kDone},
                                             {CoverStatus::kPartial, Exit::kNone},
                                             {CoverStatus::kInfeasible, Exit::kNone},
                                             {CoverStatus::kInterrupted, Exit::kInterrupted}};
  return deliver(options.common, answer_of(*job, done, status, clock.now_s() - begin_s), exits.at(status));
}

}  // namespace

void add_cover(CLI::App& app, Exit& exit) {
  CLI::App* command =
      app.add_subcommand("cover", "Plan the coverage of fields with recharging on a ground robot");
  const auto options = std::make_shared<CoverOptions>();
  const std::map<std::string, gtsp::Mode> modes = {
      {"fast", gtsp::Mode::kFast}, {"default", gtsp::Mode::kDefault}, {"slow", gtsp::Mode::kSlow}};
  command->add_option("FILE", options->file, "Scenario (.yaml), or fields (.geojson, .kml, …)")->required();
  command->add_option("--mode", options->mode, "How long the tour search goes on: fast, default or slow")
      ->transform(CLI::CheckedTransformer(modes))
      ->option_text("fast|default|slow");
  command
      ->add_option("--time-limit", options->time_limit_s,
                   "Stop after so many seconds with the best plan so far")
      ->check(CLI::PositiveNumber);
  command->add_flag("--compare-full-graph", options->compare_full_graph,
                    "Also solve the graph with all edges, for full_graph_gap_percent");
  add_fleet_options(*command, *options);
  add_fields_options(*command, *options);
  add_common(*command, options->common,
             "  swallowtail cover tests/data/missions/two_heights.yaml\n"
             "  swallowtail cover fields.geojson --sensor-width 10 --height 25 --json\n"
             "  swallowtail cover parcels.geojson --sensor-width 12 --field nl-3-0 -o legs.geojson\n"
             "  swallowtail cover field.kml --sensor-width 8 --no-fly ponds.geojson -o mission.plan\n"
             "  swallowtail cover field.kml --sensor-width 10 --aircraft 3 --apart 15 -o mission.plan\n"
             "  (which writes mission-1.plan, mission-2.plan and mission-3.plan)\n"
             "  -o writes .json, .csv (legs), .geojson or .kml (legs, transfers, rendezvous), .plan\n"
             "  (QGroundControl), or a picture: .svg, .png (this by rsvg-convert, Debian's librsvg2-bin)");
  command->callback([options, &exit] { exit = run_cover(*options); });
}

}  // namespace swallowtail::cli
