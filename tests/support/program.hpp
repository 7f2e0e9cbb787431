#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace swallowtail::testing {

using Limit = std::chrono::seconds;

/// A child process whose output is gathered. Killed and reaped by the destructor, and when the test dies.
class Program {
 public:
  /// `environment`: NAME=VALUE, added to the test's own.
  explicit Program(const std::vector<std::string>& command, const std::vector<std::string>& environment = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  pid_t pid() const { return pid_; }
  const std::string& out() const { return out_; }
  const std::string& err() const { return err_; }

  /// Reads until standard output (or error) holds `text`; false when it ends or the time is up first.
  bool wait_for_out(const std::string& text, Limit limit);
  bool wait_for_err(const std::string& text, Limit limit);
  void send(int signal) const;

  /// Reads to the end and waits for it; the exit code, 128 + n for signal n, or −1 when the time is up first
  /// (it is killed then).
  int finish(Limit limit);

 private:
  bool wait_for(const std::string& gathered, const std::string& text, Limit limit);
  /// Reads what comes within a tenth of a second; false once both pipes are closed.
  bool read_some();

  pid_t pid_ = -1;
  int out_fd_ = -1;
  int err_fd_ = -1;
  std::string out_;
  std::string err_;
};

/// Looks again and again; false when the time is up first.
bool wait_until(const std::function<bool()>& holds, Limit limit);

struct Child {
  pid_t pid = 0;
  std::string name;  ///< of the program
};

/// The children of all threads of a process.
std::vector<Child> children_of(pid_t pid);

/// Whether the process runs (one that waits to be reaped does not) and is still that program.
bool is_running(const Child& child);

/// Files in /dev/shm that the process has mapped.
std::set<std::string> shared_memory_of(pid_t pid);

}  // namespace swallowtail::testing
