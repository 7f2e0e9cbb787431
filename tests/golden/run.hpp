#pragma once

#include <string>
#include <vector>

#include "tests/support/program.hpp"

namespace swallowtail::test {

inline constexpr testing::Limit kLongestRun{240};

/// The command that starts this build's `swallowtail` with arguments.
std::vector<std::string> swallowtail(const std::vector<std::string>& arguments);

struct Outcome {
  int exit_code = -1;  ///< of testing::Program::finish
  std::string out;
  std::string err;
};

/// Runs `swallowtail` to its end.
Outcome run(const std::vector<std::string>& arguments);

/// A folder of this test's own, removed with the object.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace swallowtail::test
