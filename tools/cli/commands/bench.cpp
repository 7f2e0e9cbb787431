#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "tools/cli/commands.hpp"

namespace swallowtail::cli {
namespace {

namespace fs = std::filesystem;

/// Becomes the program `swallowtail-bench` that stands beside this one; returns only if that fails.
Exit run_bench(const std::vector<std::string>& words) {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  const fs::path program = self.parent_path() / "swallowtail-bench";
  if (error || !fs::exists(program, error))
    return fail(not_found(program.string() +
                          ": no such program; `bench` was not built (CMake target swallowtail-bench)."));
  std::vector<std::string> all{program.string()};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  return fail(internal_error(fmt::format("{}: cannot be run: {}.", program.string(), std::strerror(errno))));
}

}  // namespace

void add_bench(CLI::App& app, Exit& exit) {
  CLI::App* command =
      app.add_subcommand("bench", "Measure planners beside what one would use instead: plan, gtsp, seeds");
  command->set_help_flag();
  command->prefix_command();
  command->callback([command, &exit] { exit = run_bench(command->remaining()); });
}

}  // namespace swallowtail::cli
