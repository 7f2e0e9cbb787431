#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "tools/bench/core/report.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {

/// What every bench takes besides cli::Common.
struct Options {
  cli::Common common;
  int runs = 0;             ///< seeds, from common.seed on; 0: the bench's own number
  double time_limit_s = 0;  ///< CPU seconds of one run; 0: the bench's own
  bool quick = false;       ///< small cases, few seeds: to see that it works, not to judge by
  std::string data;         ///< folder of the bench's own files
};

/// Adds them, and `examples` below the help text.
void add_options(CLI::App& command, Options& options, const std::string& examples);

/// Refuses, before any work is done, an output file of an unknown kind and a data folder that is not there.
Status check(const Options& options);

int runs_of(const Options& options, int full, int quick);
double time_limit_of(const Options& options, double full_s, double quick_s);

/// Prints and writes the report as the options ask. An interrupted bench reports what it has and gives
/// Exit::kInterrupted.
cli::Exit deliver(const Options& options, Report report);

}  // namespace swallowtail::bench
