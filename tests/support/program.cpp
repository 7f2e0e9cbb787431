#include "tests/support/program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace swallowtail::testing {
namespace {

using SteadyTime = std::chrono::steady_clock;

[[noreturn]] void become(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                         int out, int err) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  for (const std::string& pair : environment) putenv(const_cast<char*>(pair.c_str()));
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  _exit(127);
}

/// Appends what is there; closes and marks the end.
void drain(int& fd, std::string& to) {
  std::array<char, 65536> buffer{};
  const ssize_t count = read(fd, buffer.data(), buffer.size());
  if (count > 0) {
    to.append(buffer.data(), static_cast<std::size_t>(count));
  } else if (count == 0) {
    close(fd);
    fd = -1;
  }
}

std::string first_line(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

}  // namespace

Program::Program(const std::vector<std::string>& command, const std::vector<std::string>& environment) {
  std::array<int, 2> out{};
  std::array<int, 2> err{};
  if (pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(err.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("no process");
  if (pid_ == 0) become(command, environment, out[1], err[1]);
  close(out[1]);
  close(err[1]);
  out_fd_ = out[0];
  err_fd_ = err[0];
}

Program::~Program() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (out_fd_ >= 0) close(out_fd_);
  if (err_fd_ >= 0) close(err_fd_);
}

bool Program::read_some() {
  std::array<pollfd, 2> fds{{{out_fd_, POLLIN, 0}, {err_fd_, POLLIN, 0}}};
  if (poll(fds.data(), fds.size(), 100) > 0) {
    if (fds[0].revents != 0) drain(out_fd_, out_);
    if (fds[1].revents != 0) drain(err_fd_, err_);
  }
  return out_fd_ >= 0 || err_fd_ >= 0;
}

bool Program::wait_for(const std::string& gathered, const std::string& text, Limit limit) {
  const auto end = SteadyTime::now() + limit;
  while (gathered.find(text) == std::string::npos) {
    if (SteadyTime::now() >= end || !read_some()) return gathered.find(text) != std::string::npos;
  }
  return true;
}

bool Program::wait_for_out(const std::string& text, Limit limit) { return wait_for(out_, text, limit); }
bool Program::wait_for_err(const std::string& text, Limit limit) { return wait_for(err_, text, limit); }

void Program::send(int signal) const { kill(pid_, signal); }

int Program::finish(Limit limit) {
  const auto end = SteadyTime::now() + limit;
  while (read_some()) {
    if (SteadyTime::now() < end) continue;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
    return -1;
  }
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool wait_until(const std::function<bool()>& holds, Limit limit) {
  const auto end = SteadyTime::now() + limit;
  while (!holds()) {
    if (SteadyTime::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // between two looks
  }
  return true;
}

std::vector<Child> children_of(pid_t pid) {
  std::vector<Child> children;
  std::error_code gone;
  for (const auto& thread :
       std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task", gone)) {
    std::ifstream in(thread.path() / "children");
    for (pid_t child = 0; in >> child;) {
      const std::string command = first_line("/proc/" + std::to_string(child) + "/cmdline");
      children.push_back({child, std::filesystem::path(command.c_str()).filename().string()});
    }
  }
  return children;
}

bool is_running(const Child& child) {
  const std::string folder = "/proc/" + std::to_string(child.pid);
  // A process that waits to be reaped has no command line left.
  const std::string command = first_line(folder + "/cmdline");
  return std::filesystem::path(command.c_str()).filename() == child.name;
}

std::set<std::string> shared_memory_of(pid_t pid) {
  std::set<std::string> files;
  std::ifstream maps("/proc/" + std::to_string(pid) + "/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::size_t at = line.find("/dev/shm/");
    if (at != std::string::npos && line.find(" (deleted)") == std::string::npos)
      files.insert(line.substr(at));
  }
  return files;
}

}  // namespace swallowtail::testing
