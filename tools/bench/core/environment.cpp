#include "tools/bench/core/environment.hpp"

#include <sys/utsname.h>

#include <fstream>
#include <sstream>
#include <thread>

#include "tools/bench/core/revision.hpp"

namespace swallowtail::bench {

std::string processor_of(const std::string& cpuinfo) {
  std::istringstream lines(cpuinfo);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

Environment this_environment() {
  std::ifstream file("/proc/cpuinfo");
  std::ostringstream cpuinfo;
  cpuinfo << file.rdbuf();
  utsname system{};
  uname(&system);
  return {{"processor", processor_of(cpuinfo.str())},
          {"cores", std::to_string(std::thread::hardware_concurrency())},
          {"system", std::string(system.sysname) + " " + system.release + " " + system.machine},
          {"compiler", SWALLOWTAIL_COMPILER},
          {"flags", SWALLOWTAIL_BUILD_FLAGS},
          {"version", SWALLOWTAIL_VERSION},
          {"revision", kRevision}};
}

}  // namespace swallowtail::bench
