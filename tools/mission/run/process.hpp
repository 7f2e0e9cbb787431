#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "planner/base/result.hpp"

namespace swallowtail::mission {

/// A child process with its output on pipes. It dies with its parent, however that ends; the destructor stops
/// it.
class Process {
 public:
  /// argv[0] is the program's path.
  static Result<Process> start(std::string name, const std::vector<std::string>& argv);
  Process(Process&& other) noexcept;
  Process& operator=(Process&&) = delete;
  ~Process();

  const std::string& name() const { return name_; }
  pid_t pid() const { return pid_; }
  int out_fd() const { return out_fd_; }

  /// Whole lines of standard output that have come in since; never waits.
  std::vector<std::string> take_lines();

  /// The last lines of standard error, for a message about why it ended.
  std::string last_errors();

  /// Exit code once it has ended (128 + n for signal n); never waits.
  std::optional<int> poll();

  /// Asks it to stop (SIGINT) without waiting. It is asked once: participants take a second request as an
  /// order to leave at once, with shared memory and open files as they are.
  void ask_to_stop();

  /// Asks it to stop and waits up to `patience_s`, then kills it. Returns the exit code.
  int stop(double patience_s);

 private:
  Process(std::string name, pid_t pid, int out_fd, int err_fd);
  void drain();

  std::string name_;
  pid_t pid_ = -1;
  int out_fd_ = -1;
  int err_fd_ = -1;
  std::optional<int> exit_code_;
  bool asked_ = false;
  std::string out_;
  std::string errors_;
};

}  // namespace swallowtail::mission
