#include "tools/bench/core/memory.hpp"

#include <malloc.h>

#include <fstream>
#include <limits>
#include <string>

namespace swallowtail::bench {
namespace {

double status_mb(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) == 0) return std::stod(line.substr(key.size() + 1)) / 1024.0;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

PeakMemory::PeakMemory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // the kernel's way to begin VmHWM anew
  before_mb_ = status_mb("VmRSS");
}

double PeakMemory::taken_mb() const { return status_mb("VmHWM") - before_mb_; }

}  // namespace swallowtail::bench
