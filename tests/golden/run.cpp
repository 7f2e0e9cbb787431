#include "tests/golden/run.hpp"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace swallowtail::test {

std::vector<std::string> swallowtail(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{SWALLOWTAIL_BINARY_DIR "/bin/swallowtail"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

Outcome run(const std::vector<std::string>& arguments) {
  testing::Program program(swallowtail(arguments));
  const int exit_code = program.finish(kLongestRun);
  return {exit_code, program.out(), program.err()};
}

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "swallowtail_golden_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no scratch folder");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

}  // namespace swallowtail::test
