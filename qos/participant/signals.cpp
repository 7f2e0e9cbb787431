#include "qos/participant/signals.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>

namespace swallowtail {
namespace {

constexpr int kExitInterrupted = 130;

// What a signal handler may touch: lock-free atomics and file descriptors.
std::atomic<bool> g_requested{false};
std::atomic<int> g_wake_write{-1};
int g_wake_read = -1;
struct sigaction g_old_int;
struct sigaction g_old_term;
struct sigaction g_old_pipe;

void wake() {
  const int fd = g_wake_write.load();
  const char byte = 1;
  if (fd >= 0 && write(fd, &byte, 1) < 0) return;  // a full pipe is awake already
}

void on_signal(int) {
  const int saved = errno;
  if (g_requested.exchange(true)) _exit(kExitInterrupted);
  wake();
  errno = saved;
}

}  // namespace

StopSignals::StopSignals() {
  g_requested.store(false);
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) == 0) {
    g_wake_read = ends[0];
    g_wake_write.store(ends[1]);
  }
  struct sigaction action = {};
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, &g_old_int);
  sigaction(SIGTERM, &action, &g_old_term);
  action.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &action, &g_old_pipe);
}

StopSignals::~StopSignals() {
  sigaction(SIGINT, &g_old_int, nullptr);
  sigaction(SIGTERM, &g_old_term, nullptr);
  sigaction(SIGPIPE, &g_old_pipe, nullptr);
  const int write_end = g_wake_write.exchange(-1);
  if (write_end >= 0) close(write_end);
  if (g_wake_read >= 0) close(g_wake_read);
  g_wake_read = -1;
}

const std::atomic<bool>& StopSignals::flag() const { return g_requested; }

void StopSignals::request() {
  g_requested.store(true);
  wake();
}

bool StopSignals::wait_for(double seconds) const {
  if (requested() || !(seconds > 0.0)) return requested();
  timespec timeout = {};
  timeout.tv_sec = static_cast<time_t>(std::floor(std::fmin(seconds, 86400.0)));
  timeout.tv_nsec =
      static_cast<long>((std::fmin(seconds, 86400.0) - static_cast<double>(timeout.tv_sec)) * 1e9);
  pollfd wake_end = {.fd = g_wake_read, .events = POLLIN, .revents = 0};
  ppoll(&wake_end, 1, &timeout, nullptr);
  return requested();
}

}  // namespace swallowtail
