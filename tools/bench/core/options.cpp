#include "tools/bench/core/options.hpp"

#include <filesystem>

#include <fmt/core.h>

namespace swallowtail::bench {

void add_options(CLI::App& command, Options& options, const std::string& examples) {
  options.data = SWALLOWTAIL_BENCH_DATA;
  command.add_option("--runs", options.runs, "Seeds of each subject on each case, from --seed on")
      ->check(CLI::Range(1, 100000));
  command.add_option("--time-limit", options.time_limit_s, "CPU seconds of one run")
      ->check(CLI::Range(1e-4, 1e5));
  command.add_flag("--quick", options.quick, "Small cases and few seeds: to see that it works");
  command.add_option("--data", options.data, "Folder of scenes and best known values")->capture_default_str();
  cli::add_common(command, options.common, examples + "\n  -o writes .csv, .json, .md or .html (with plots)");
}

Status check(const Options& options) {
  if (const Status status = cli::check_output(options.common, report_extensions()); !status) return status;
  std::error_code error;
  if (!std::filesystem::is_directory(options.data, error))
    return not_found("--data " + options.data + ": no such folder.");
  return {};
}

int runs_of(const Options& options, int full, int quick) {
  if (options.runs > 0) return options.runs;
  return options.quick ? quick : full;
}

double time_limit_of(const Options& options, double full_s, double quick_s) {
  if (options.time_limit_s > 0) return options.time_limit_s;
  return options.quick ? quick_s : full_s;
}

cli::Exit deliver(const Options& options, Report report) {
  const bool interrupted = cli::interrupted();
  report.status = interrupted ? "interrupted" : "done";
  return cli::deliver(options.common, answer_of(report),
                      interrupted ? cli::Exit::kInterrupted : cli::Exit::kDone);
}

}  // namespace swallowtail::bench
