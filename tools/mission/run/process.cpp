#include "tools/mission/run/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

namespace swallowtail::mission {
namespace {

constexpr std::size_t kKeptErrors = 4000;

/// Reads what is there into `text`.
void read_available(int fd, std::string& text) {
  char buffer[4096];
  for (;;) {
    const ssize_t got = ::read(fd, buffer, sizeof buffer);
    if (got <= 0) return;
    text.append(buffer, static_cast<std::size_t>(got));
  }
}

[[noreturn]] void become(const std::vector<std::string>& argv, int out_fd, int err_fd, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127);
  // Ctrl-C reaches the parent only, which stops its children in order.
  ::setpgid(0, 0);
  ::dup2(out_fd, STDOUT_FILENO);
  ::dup2(err_fd, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const auto& argument : argv) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  ::execv(arguments[0], arguments.data());
  const char message[] = "cannot be started\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message, sizeof message - 1);
  ::_exit(127);
}

}  // namespace

Result<Process> Process::start(std::string name, const std::vector<std::string>& argv) {
  int out[2];
  int err[2];
  if (::pipe2(out, O_CLOEXEC) != 0)
    return internal_error("No pipe for " + name + ": " + std::strerror(errno) + ".");
  if (::pipe2(err, O_CLOEXEC) != 0) {
    ::close(out[0]);
    ::close(out[1]);
    return internal_error("No pipe for " + name + ": " + std::strerror(errno) + ".");
  }
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid == 0) become(argv, out[1], err[1], parent);
  ::close(out[1]);
  ::close(err[1]);
  if (pid < 0) {
    ::close(out[0]);
    ::close(err[0]);
    return internal_error("Cannot fork for " + name + ": " + std::strerror(errno) + ".");
  }
  ::fcntl(out[0], F_SETFL, O_NONBLOCK);
  ::fcntl(err[0], F_SETFL, O_NONBLOCK);
  return Process(std::move(name), pid, out[0], err[0]);
}

Process::Process(std::string name, pid_t pid, int out_fd, int err_fd)
    : name_(std::move(name)), pid_(pid), out_fd_(out_fd), err_fd_(err_fd) {}

Process::Process(Process&& other) noexcept
    : name_(std::move(other.name_)),
      pid_(std::exchange(other.pid_, -1)),
      out_fd_(std::exchange(other.out_fd_, -1)),
      err_fd_(std::exchange(other.err_fd_, -1)),
      exit_code_(other.exit_code_),
      asked_(other.asked_),
      out_(std::move(other.out_)),
      errors_(std::move(other.errors_)) {}

Process::~Process() {
  if (pid_ > 0) stop(2.0);
  if (out_fd_ >= 0) ::close(out_fd_);
  if (err_fd_ >= 0) ::close(err_fd_);
}

void Process::drain() {
  if (out_fd_ >= 0) read_available(out_fd_, out_);
  if (err_fd_ >= 0) read_available(err_fd_, errors_);
  if (errors_.size() > kKeptErrors) errors_.erase(0, errors_.size() - kKeptErrors);
}

std::vector<std::string> Process::take_lines() {
  drain();
  std::vector<std::string> lines;
  std::size_t from = 0;
  for (std::size_t end = out_.find('\n'); end != std::string::npos; end = out_.find('\n', from)) {
    lines.push_back(out_.substr(from, end - from));
    from = end + 1;
  }
  out_.erase(0, from);
  return lines;
}

std::string Process::last_errors() {
  drain();
  return errors_;
}

std::optional<int> Process::poll() {
  if (exit_code_ || pid_ <= 0) return exit_code_;
  int status = 0;
  if (::waitpid(pid_, &status, WNOHANG) == pid_) {
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  return exit_code_;
}

void Process::ask_to_stop() {
  if (pid_ > 0 && !exit_code_ && !asked_) ::kill(pid_, SIGINT);
  asked_ = true;
}

int Process::stop(double patience_s) {
  ask_to_stop();
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  while (!poll() && std::chrono::steady_clock::now() < until) {
    drain();  // a child must not block on a full pipe while it ends
    pollfd ended{out_fd_, POLLIN, 0};
    ::poll(&ended, 1, 20);
  }
  if (!poll()) {
    ::kill(pid_, SIGKILL);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    exit_code_ = 128 + SIGKILL;
  }
  pid_ = -1;
  return *exit_code_;
}

}  // namespace swallowtail::mission
