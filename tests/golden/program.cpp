#include "tests/golden/program.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace swallowtail::test {
namespace {

const std::string kProgram = SWALLOWTAIL_BINARY_DIR "/bin/swallowtail";

[[noreturn]] void become(const std::vector<std::string>& arguments, const std::array<int, 2>& out,
                         const std::array<int, 2>& err) {
  dup2(out[1], STDOUT_FILENO);
  dup2(err[1], STDERR_FILENO);
  std::vector<char*> argv;
  argv.push_back(const_cast<char*>(kProgram.c_str()));
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(kProgram.c_str(), argv.data());
  _exit(127);
}

/// Appends what is there; closes and marks the end.
void drain(int& fd, std::string& to) {
  std::array<char, 65536> buffer{};
  const ssize_t count = read(fd, buffer.data(), buffer.size());
  if (count > 0) {
    to.append(buffer.data(), static_cast<std::size_t>(count));
  } else if (count == 0 || errno != EINTR) {
    close(fd);
    fd = -1;
  }
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments) {
  std::array<int, 2> out{};
  std::array<int, 2> err{};
  if (pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(err.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  pid_ = fork();
  if (pid_ == 0) become(arguments, out, err);
  close(out[1]);
  close(err[1]);
  out_ = out[0];
  err_ = err[0];
}

Program::~Program() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (out_ >= 0) close(out_);
  if (err_ >= 0) close(err_);
}

void Program::read_some() {
  std::array<pollfd, 2> fds{{{out_, POLLIN, 0}, {err_, POLLIN, 0}}};  // poll passes over those that are −1
  if (poll(fds.data(), fds.size(), -1) < 0) return;
  if (fds[0].revents != 0) drain(out_, outcome_.out);
  if (fds[1].revents != 0) drain(err_, outcome_.err);
}

bool Program::wait_for_error_output(const std::string& text) {
  while (outcome_.err.find(text) == std::string::npos) {
    if (err_ < 0) return false;
    read_some();
  }
  return true;
}

void Program::send(int signal) const { kill(pid_, signal); }

Outcome Program::finish() {
  while (out_ >= 0 || err_ >= 0) read_some();
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  outcome_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome_;
}

Outcome run(const std::vector<std::string>& arguments) { return Program(arguments).finish(); }

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
