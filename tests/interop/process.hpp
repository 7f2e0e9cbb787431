#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace swallowtail::testing {

/// A child process whose standard input and output are pipes. Killed and reaped by the destructor.
class Process {
 public:
  explicit Process(const std::vector<std::string>& command);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Waits until it has written the line; false when it ends or the time is up first.
  bool wait_for_line(const std::string& line, std::chrono::milliseconds limit);
  void write_line(const std::string& line);
  void send(int signal);
  /// Ends its input and waits for it; the exit code, or -1 when it was killed.
  int finish();

 private:
  void close_input();

  pid_t id_ = -1;
  int input_ = -1;
  int output_ = -1;
  std::string pending_;
};

}  // namespace swallowtail::testing
