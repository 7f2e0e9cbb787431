#include "tools/drawing/png.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>

extern char** environ;

namespace swallowtail::drawing {
namespace {

constexpr const char* kProgram = "rsvg-convert";

/// Closes its ends, also those that a child has.
class Pipe {
 public:
  Pipe() { is_open_ = ::pipe2(ends_.data(), O_CLOEXEC) == 0; }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  bool is_open() const { return is_open_; }
  int end(std::size_t which) const { return ends_[which]; }
  void close_end(std::size_t which) {
    if (is_open_ && ends_[which] >= 0) ::close(ends_[which]);
    ends_[which] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
  bool is_open_ = false;
};

bool send(int to, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t sent = ::write(to, text.data() + done, text.size() - done);
    if (sent < 0 && errno != EINTR) return false;
    if (sent > 0) done += static_cast<std::size_t>(sent);
  }
  return true;
}

bool ended_well(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return false;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// The child, reading from the pipe; 0: it could not be started.
pid_t start(const Pipe& pipe, const std::string& path) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe.end(0), STDIN_FILENO);
  std::array<std::string, 5> words{kProgram, "--format", "png", "--output", path};
  std::array<char*, 6> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  pid_t child = 0;
  if (::posix_spawnp(&child, kProgram, &actions, nullptr, arguments.data(), environ) != 0) child = 0;
  posix_spawn_file_actions_destroy(&actions);
  return child;
}

}  // namespace

bool can_draw_png() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((std::filesystem::path(folder) / kProgram).c_str(), X_OK) == 0) return true;
  }
  return false;
}

Status write_png(const std::string& svg, const std::string& path) {
  Pipe pipe;
  const pid_t child = pipe.is_open() ? start(pipe, path) : 0;
  if (child == 0)
    return bad_input(path + ": needs the program rsvg-convert (Debian: librsvg2-bin), which did not start.");
  pipe.close_end(0);
  // A child that ends early must not end us.
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  const bool is_sent = send(pipe.end(1), svg);
  std::signal(SIGPIPE, before);
  pipe.close_end(1);
  const bool is_drawn = ended_well(child);
  if (!is_sent || !is_drawn) return bad_input(path + ": rsvg-convert could not draw or write it.");
  return {};
}

}  // namespace swallowtail::drawing
