#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/core.h>

#include "coverage/field/geojson.hpp"
#include "tools/bench/core/statistics.hpp"
#include "tools/bench/cover/parts.hpp"
#include "tools/bench/cover/tasks.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {
namespace {

namespace fs = std::filesystem;

/// A field file's name stands for its fields; the shipped ones are few.
constexpr std::size_t kQuickFields = 3;

fs::path folder_of(const CoverOptions& options) {
  if (!options.fields.empty()) return options.fields;
  const char* named = std::getenv("SWALLOWTAIL_DATA");
  const fs::path real = fs::path(named != nullptr ? named : SWALLOWTAIL_DEFAULT_DATA) / "fields";
  std::error_code error;
  if (!options.base.quick && fs::is_directory(real, error)) return real;
  return fs::path(options.base.data) / "cover";
}

struct Totals {
  std::size_t planned = 0;
  std::size_t refused = 0;
  std::vector<double> cpu_ms;
  std::vector<double> covered_percent;
  double cost_s = 0.0;
};

/// "Field 'x': because …" without the name, so that like reasons are counted as one.
std::string reason_of(const std::string& message) {
  const std::size_t colon = message.find("': ");
  return colon == std::string::npos ? message : message.substr(colon + 3);
}

void measure_field(CoverBench& bench, const std::string& name, const coverage::Task& task, Totals& totals) {
  const std::uint64_t seed = bench.options.base.common.seed;
  const Planned planned = plan_timed(task, seed);
  totals.cpu_ms.push_back(planned.cpu_ms);
  bench.add(name, seed, "cpu", planned.cpu_ms, "ms");
  bench.add(name, seed, "planned", planned.plan ? 1.0 : 0.0, "");
  if (!planned.plan) {
    ++totals.refused;
    bench.report.extra["refused"][name] = reason_of(planned.plan.error().message);
    return;
  }
  ++totals.planned;
  totals.covered_percent.push_back(planned.plan->covered_percent);
  totals.cost_s += planned.plan->cost;
  bench.add(name, seed, "covered", planned.plan->covered_percent, "%");
  bench.add(name, seed, "cost", planned.plan->cost, "s");
  bench.add(name, seed, "outside", planned.plan->fields.front().outside_m2, "m2");
}

std::vector<std::string> row_of(const std::string& name, const Totals& totals, const std::string& peers) {
  std::vector<double> sorted = totals.cpu_ms;
  std::ranges::sort(sorted);
  return {
      name,
      std::to_string(totals.planned + totals.refused),
      std::to_string(totals.planned),
      std::to_string(totals.refused),
      totals.covered_percent.empty() ? "-" : fmt::format("{:.3f}", quartiles_of(totals.covered_percent).min),
      totals.covered_percent.empty() ? "-" : fmt::format("{:.3f}", median_of(totals.covered_percent)),
      significant(quantile(sorted, 0.5), 3),
      significant(quantile(sorted, 0.9), 3),
      significant(sorted.back(), 3),
      significant(totals.cost_s, 6),
      peers};
}

void merge(const Totals& from, Totals& to) {
  to.planned += from.planned;
  to.refused += from.refused;
  to.cpu_ms.insert(to.cpu_ms.end(), from.cpu_ms.begin(), from.cpu_ms.end());
  to.covered_percent.insert(to.covered_percent.end(), from.covered_percent.begin(),
                            from.covered_percent.end());
  to.cost_s += from.cost_s;
}

Result<std::vector<fs::path>> files_of(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return not_found("--fields " + folder.string() + ": no such folder.");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".geojson") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  if (files.empty()) return not_found("--fields " + folder.string() + ": has no .geojson file.");
  return files;
}

}  // namespace

Status measure_parcels(CoverBench& bench) {
  const fs::path folder = folder_of(bench.options);
  const auto files = files_of(folder);
  if (!files) return files.error();
  bench.report.notes.push_back("Parcels: " + folder.string() + ".");
  Table table{"Parcels, strips of 10 m",
              {"file", "fields", "planned", "refused", "least covered %", "median %", "CPU ms median", "p90",
               "worst", "cost s", "peers"},
              {}};
  const ThreadCpuClock clock;
  const double ends_s = clock.now_s() + bench.budget_s;
  Totals all;
  std::size_t left_out = 0;
  for (const fs::path& path : *files) {
    coverage::FieldFileOptions options;
    options.frame = coverage::FieldFrame::kPerField;
    const auto file = coverage::read_fields(path.string(), options);
    if (!file) return file.error();
    Totals totals;
    for (std::size_t i = 0; i < file->fields.size(); ++i) {
      if (cli::interrupted()) break;
      if (clock.now_s() > ends_s || (bench.options.base.quick && i >= kQuickFields)) {
        ++left_out;
        continue;
      }
      bench.progress.update(
          fmt::format("{}, field {} of {}", path.filename().string(), i + 1, file->fields.size()));
      coverage::Task task = task_of(file->fields[i]);
      if (i < file->no_fly.size()) task.no_fly = file->no_fly[i];
      measure_field(bench, path.stem().string() + "/" + file->fields[i].name, task, totals);
    }
    if (totals.cpu_ms.empty()) continue;
    table.rows.push_back(row_of(path.filename().string(), totals, "-"));
    merge(totals, all);
  }
  if (!all.cpu_ms.empty()) table.rows.push_back(row_of("all", all, peers_cell(bench.peers, "parcels")));
  if (left_out > 0)
    bench.report.notes.push_back(fmt::format("{} fields left out (--budget, --quick).", left_out));
  bench.report.tables.push_back(std::move(table));
  return {};
}

}  // namespace swallowtail::bench
