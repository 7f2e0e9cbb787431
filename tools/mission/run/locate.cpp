#include "tools/mission/run/locate.hpp"

#include <filesystem>

namespace swallowtail::mission {

std::string program_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

}  // namespace swallowtail::mission
