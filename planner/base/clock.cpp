#include "planner/base/clock.hpp"

#include <sys/resource.h>

#include <chrono>
#include <ctime>

namespace swallowtail {
namespace {

double cpu_s(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

double SteadyClock::now_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double ThreadCpuClock::now_s() const { return cpu_s(CLOCK_THREAD_CPUTIME_ID); }

double process_cpu_s() { return cpu_s(CLOCK_PROCESS_CPUTIME_ID); }

double process_peak_rss_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace swallowtail
