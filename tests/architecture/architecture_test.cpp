// Reads the sources and holds them against the rules of CONTRIBUTING.md: dependencies point one way,
// third-party headers stay out of public headers, the vendors never meet.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SWALLOWTAIL_SOURCE_DIR;

/// What each module may include, besides itself. A module is a folder; the longest one that a file's path
/// starts with is its own.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"planner/base", {}},
    {"planner/world", {"planner/base"}},
    {"planner/path", {"planner/base", "planner/world"}},
    {"planner/scenario", {"planner/base", "planner/world", "planner/path"}},
    {"planner/swarm", {"planner/base"}},
    {"planner/kernels", {"planner/base", "planner/world", "planner/path"}},
    {"planner/cost", {"planner/base", "planner/world", "planner/path", "planner/kernels", "planner/swarm"}},
    {"planner/replan",
     {"planner/base", "planner/world", "planner/path", "planner/kernels", "planner/swarm", "planner/cost"}},
    {"planner/participant",
     {"planner/base", "planner/world", "planner/path", "planner/replan", "idl", "qos"}},
    {"coverage/field", {"planner/base", "planner/world"}},
    {"coverage/gtsp", {"planner/base"}},
    {"coverage/ground", {"planner/base", "planner/world", "coverage/field"}},
    {"coverage/energy",
     {"planner/base", "planner/world", "planner/path", "coverage/field", "coverage/ground"}},
    {"coverage/schedule",
     {"planner/base", "planner/world", "planner/path", "coverage/field", "coverage/ground", "coverage/energy",
      "coverage/gtsp"}},
    {"coverage/fleet",
     {"planner/base", "planner/world", "planner/path", "coverage/field", "coverage/ground", "coverage/energy",
      "coverage/gtsp", "coverage/schedule"}},
    {"coverage/maintain",
     {"planner/base", "planner/world", "planner/path", "coverage/field", "coverage/ground", "coverage/energy",
      "coverage/gtsp", "coverage/schedule"}},
    {"coverage/task",
     {"planner/base", "planner/world", "planner/path", "planner/scenario", "coverage/field",
      "coverage/ground", "coverage/energy"}},
    {"coverage/participant",
     {"planner/base", "planner/world", "planner/path", "coverage/field", "coverage/ground", "coverage/energy",
      "coverage/gtsp", "coverage/schedule", "coverage/maintain", "idl", "qos"}},
    {"charger/motion", {"planner/base", "planner/world", "planner/path"}},
    {"charger/charging", {"planner/base", "planner/world", "planner/path", "charger/motion"}},
    {"charger/participant",
     {"planner/base", "planner/world", "planner/path", "charger/motion", "charger/charging", "idl", "qos"}},
    {"idl", {"planner/base"}},
    {"qos", {"planner/base", "idl"}},
};

struct Include {
  fs::path file;
  int line = 0;
  std::string target;
  bool quoted = false;
};

bool is_source(const fs::path& path) {
  const auto extension = path.extension();
  return extension == ".hpp" || extension == ".cpp" || extension == ".h" || extension == ".c";
}

std::vector<fs::path> sources() {
  std::vector<fs::path> files;
  for (const char* top : {"planner", "coverage", "charger", "idl", "qos", "tools", "tests"}) {
    for (auto it = fs::recursive_directory_iterator(kRoot / top); it != fs::recursive_directory_iterator();
         ++it) {
      if (it->is_directory() && it->path().filename() == "node_modules") it.disable_recursion_pending();
      if (it->is_regular_file() && is_source(it->path())) files.push_back(it->path());
    }
  }
  return files;
}

std::vector<Include> includes_of(const fs::path& file) {
  std::vector<Include> includes;
  std::ifstream stream(file);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.rfind("#include ", 0) != 0) continue;
    const char close = line[9] == '"' ? '"' : '>';
    includes.push_back({file, number, line.substr(10, line.find(close, 10) - 10), close == '"'});
  }
  return includes;
}

std::string module_of(const std::string& path) {
  std::string best;
  for (const auto& [module, unused] : kMayInclude) {
    if (path.rfind(module + "/", 0) == 0 && module.size() > best.size()) best = module;
  }
  return best;
}

std::string where(const Include& include) {
  return fs::relative(include.file, kRoot).string() + ":" + std::to_string(include.line) + " includes " +
         include.target;
}

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  for (const auto& prefix : prefixes) {
    if (text.rfind(prefix, 0) == 0) return true;
  }
  return false;
}

const std::vector<std::string> kVendorHeaders = {"fastdds/", "fastrtps/", "fastcdr/", "dds/", "ddsc/"};

TEST(Architecture, DependenciesPointOneWay) {
  std::size_t seen = 0;
  for (const auto& file : sources()) {
    const std::string from = module_of(fs::relative(file, kRoot).string());
    if (from.empty()) continue;
    for (const auto& include : includes_of(file)) {
      if (!include.quoted) continue;
      const std::string to = module_of(include.target);
      if (to.empty() || to == from) continue;
      ++seen;
      EXPECT_TRUE(kMayInclude.at(from).contains(to))
          << where(include) << ": " << from << " may not use " << to;
    }
  }
  EXPECT_GT(seen, 50U) << "the walk found no includes: is the source folder right?";
}

TEST(Architecture, OnlyToolsAndTestsIncludeTools) {
  for (const auto& file : sources()) {
    const std::string path = fs::relative(file, kRoot).string();
    if (starts_with_any(path, {"tools/", "tests/"})) continue;
    for (const auto& include : includes_of(file))
      EXPECT_FALSE(starts_with_any(include.target, {"tools/", "tests/"})) << where(include);
  }
}

TEST(Architecture, HeavyHeadersStayOutOfPublicHeaders) {
  const std::vector<std::string> heavy = {"fcl/",      "gdal", "ogr", "cpl_",     "geos",
                                          "yaml-cpp/", "zstd", "lz4", "nlohmann/"};
  for (const auto& file : sources()) {
    const std::string path = fs::relative(file, kRoot).string();
    if (file.extension() != ".hpp" || path.find("/detail/") != std::string::npos ||
        !starts_with_any(path, {"planner/", "coverage/", "charger/"}))
      continue;
    for (const auto& include : includes_of(file)) {
      EXPECT_FALSE(starts_with_any(include.target, heavy)) << where(include);
      EXPECT_FALSE(starts_with_any(include.target, kVendorHeaders)) << where(include);
    }
  }
}

TEST(Architecture, AlgorithmsKnowNoDds) {
  for (const auto& file : sources()) {
    const std::string path = fs::relative(file, kRoot).string();
    if (!starts_with_any(path, {"planner/", "coverage/", "charger/"})) continue;
    for (const auto& include : includes_of(file))
      EXPECT_FALSE(starts_with_any(include.target, kVendorHeaders)) << where(include);
  }
}

TEST(Architecture, VendorsNeverMeet) {
  for (const auto& file : sources()) {
    bool fast = false;
    bool cyclone = false;
    for (const auto& include : includes_of(file)) {
      fast = fast || starts_with_any(include.target, {"fastdds/", "fastrtps/"});
      cyclone = cyclone || starts_with_any(include.target, {"dds/dds", "dds/ddsi", "dds/ddsrt"});
    }
    EXPECT_FALSE(fast && cyclone) << fs::relative(file, kRoot) << " includes headers of both vendors";
  }
}

TEST(Architecture, EveryStructOfTheContractIsFinal) {
  std::size_t structs = 0;
  for (const auto& entry : fs::directory_iterator(kRoot / "idl")) {
    if (entry.path().extension() != ".idl") continue;
    std::ifstream stream(entry.path());
    std::string line;
    while (std::getline(stream, line)) {
      if (line.find("struct ") == std::string::npos || line.find("//") < line.find("struct ")) continue;
      ++structs;
      EXPECT_NE(line.find("@final"), std::string::npos) << entry.path().filename() << ": " << line;
      EXPECT_EQ(line.find("@appendable"), std::string::npos);
    }
  }
  EXPECT_GE(structs, 12U);
}

TEST(Architecture, FilesStayReadable) {
  for (const auto& file : sources()) {
    std::ifstream stream(file);
    std::string line;
    int lines = 0;
    while (std::getline(stream, line)) {
      ++lines;
      const auto todo = line.find(std::string("TO") + "DO");
      if (todo == std::string::npos) continue;
      EXPECT_NE(line.find('#', todo), std::string::npos) << file << ":" << lines << " names no issue";
    }
    EXPECT_LE(lines, 400) << fs::relative(file, kRoot) << " is too long: split it";
  }
}

}  // namespace
