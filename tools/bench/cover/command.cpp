#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "planner/base/clock.hpp"
#include "tools/bench/commands.hpp"
#include "tools/bench/cover/parts.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {
namespace {

constexpr const char* kSubject = "swallowtail cover";

struct Part {
  std::string name;
  double budget_share = 0.0;
  Status (*measure)(CoverBench&) = nullptr;
};

const std::vector<Part>& known_parts() {
  static const std::vector<Part> all{{"parcels", 0.25, measure_parcels},
                                     {"holes", 0.2, measure_holes},
                                     {"graph", 0.02, measure_graph},
                                     {"repair", 0.1, measure_repair},
                                     {"growth", 0.43, measure_growth}};
  return all;
}

std::vector<std::string> part_names() {
  std::vector<std::string> names;
  for (const Part& part : known_parts()) names.push_back(part.name);
  return names;
}

std::vector<Part> chosen(const CoverOptions& options) {
  std::vector<Part> parts;
  for (const Part& part : known_parts()) {
    if (options.parts.empty() || std::ranges::find(options.parts, part.name) != options.parts.end())
      parts.push_back(part);
  }
  return parts;
}

Status run_all(const CoverOptions& options, Report& report) {
  const auto peers = read_cover_peers(options.base.data + "/cover_peers.csv");
  if (!peers) return peers.error();
  cli::Progress progress("bench cover",
                         options.base.common.quiet ? cli::Progress::Show::kNo : cli::Progress::Show::kYes);
  const std::vector<Part> parts = chosen(options);
  double shares = 0.0;
  for (const Part& part : parts) shares += part.budget_share;
  // What one part does not use is left for the others.
  const ThreadCpuClock clock;
  const double ends_s = clock.now_s() + options.budget_s;
  for (const Part& part : parts) {
    if (cli::interrupted()) break;
    const double left_s = std::max(0.0, ends_s - clock.now_s());
    CoverBench bench{options, *peers, progress, report, left_s * part.budget_share / shares};
    if (const Status status = part.measure(bench); !status) return status;
    shares -= part.budget_share;
  }
  report.notes.emplace_back(
      "The peers' figures are measurements from a file, on another day: read ratios. The covered share is "
      "the "
      "planner's own measure.");
  return {};
}

cli::Exit run_bench(const CoverOptions& options) {
  if (const Status status = check(options.base); !status) return cli::fail(status.error());
  Report report;
  report.bench = "cover";
  if (const Status status = run_all(options, report); !status) return cli::fail(status.error());
  return deliver(options.base, std::move(report));
}

}  // namespace

void CoverBench::add(const std::string& case_name, std::uint64_t seed, const std::string& metric,
                     double value, const std::string& unit) {
  report.rows.push_back({kSubject, case_name, seed, metric, value, unit});
}

void add_cover(CLI::App& app, cli::Exit& exit) {
  CLI::App* command = app.add_subcommand(
      "cover",
      "Coverage of real parcels and fields with holes, growth and repair, beside the peers' results");
  const auto options = std::make_shared<CoverOptions>();
  command->add_option("PART", options->parts, fmt::format("Of {}; none: all", fmt::join(part_names(), ", ")))
      ->check(CLI::IsMember(part_names()));
  command->add_option("--fields", options->fields,
                      "Folder of .geojson files (default: ../shared/data/fields where it is there, else the "
                      "shipped ones)");
  command->add_option("--max-sub-cells", options->max_sub_cells, "Of the growth")
      ->check(CLI::Range(50, 16'000))
      ->capture_default_str();
  command->add_option("--budget", options->budget_s, "CPU seconds of all parts together, about")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  add_options(*command, options->base,
              "  swallowtail bench cover --quick\n"
              "  swallowtail bench cover parcels --fields farms --json\n"
              "  swallowtail bench cover growth --budget 300 -o growth.html");
  command->callback([options, &exit] { exit = run_bench(*options); });
}

}  // namespace swallowtail::bench
