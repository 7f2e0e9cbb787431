#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace swallowtail::test {

struct Outcome {
  int exit_code = -1;  ///< −1: ended by a signal
  std::string out;
  std::string err;
};

/// The program `swallowtail` of this build, started with arguments; its output is read to the end. Whatever
/// happens it does not outlive the object.
class Program {
 public:
  explicit Program(const std::vector<std::string>& arguments);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Reads until standard error holds `text` or ends; false when it ended without.
  bool wait_for_error_output(const std::string& text);
  void send(int signal) const;
  /// Waits for the end.
  Outcome finish();

 private:
  void read_some();

  pid_t pid_ = -1;
  int out_ = -1;
  int err_ = -1;
  Outcome outcome_;
};

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
