#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "planner/scenario/read.hpp"

namespace swallowtail::planner {
namespace {

namespace fs = std::filesystem;

const fs::path kCorpus = fs::path(SWALLOWTAIL_SOURCE_DIR) / "tests/data/scenarios";

const fs::path kTenErrors = kCorpus / "invalid/ten_errors.yaml";  // has a test of its own

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<fs::path> files_of(const char* folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kCorpus / folder)) {
    if (entry.path().extension() == ".yaml" && entry.path() != kTenErrors) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::string name_of(const testing::TestParamInfo<fs::path>& info) { return info.param.stem().string(); }

class ValidScenario : public testing::TestWithParam<fs::path> {};
class InvalidScenario : public testing::TestWithParam<fs::path> {};

TEST_P(ValidScenario, IsRead) {
  const ScenarioResult result = read_scenario(GetParam().string());
  ASSERT_TRUE(result.ok()) << result.errors().text();
}

/// The first line of a file says what it breaks (`# breaks: kind key`), a mark at a line's end says where.
TEST_P(InvalidScenario, GivesExactlyTheErrorItIsNamedFor) {
  const auto lines = lines_of(GetParam());
  const auto marked = std::ranges::find_if(
      lines, [](const std::string& line) { return line.find("# <- error") != std::string::npos; });
  ASSERT_NE(marked, lines.end()) << "no line is marked";
  std::istringstream head(lines.at(0));
  std::string hash, breaks, kind, key;
  head >> hash >> breaks >> kind >> key;
  ASSERT_EQ(breaks, "breaks:");

  const ScenarioResult result = read_scenario(GetParam().string());
  ASSERT_FALSE(result.ok());
  ASSERT_EQ(result.errors().errors.size(), 1u) << result.errors().text();
  const ScenarioError& error = result.errors().errors.front();
  EXPECT_EQ(name(error.kind), kind) << error.text();
  EXPECT_EQ(error.key, key == "-" ? "" : key);
  EXPECT_EQ(error.line, marked - lines.begin() + 1) << error.text();
  EXPECT_EQ(error.file, GetParam().string());
  EXPECT_FALSE(error.rule.empty());
}

INSTANTIATE_TEST_SUITE_P(Corpus, ValidScenario, testing::ValuesIn(files_of("valid")), name_of);
INSTANTIATE_TEST_SUITE_P(Corpus, InvalidScenario, testing::ValuesIn(files_of("invalid")), name_of);

TEST(ScenarioCorpus, TenErrorsAreReportedAtOnceInOrder) {
  const auto lines = lines_of(kTenErrors);
  std::vector<std::string> expected;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (const auto at = lines[i].find("# <- "); at != std::string::npos)
      expected.push_back(std::to_string(i + 1) + " " + lines[i].substr(at + 5));
  }
  const ScenarioResult result = read_scenario(kTenErrors.string());
  ASSERT_FALSE(result.ok());
  std::vector<std::string> actual;
  for (const ScenarioError& error : result.errors().errors) {
    actual.push_back(std::to_string(error.line) + " " + name(error.kind) + " " + error.key);
  }
  EXPECT_EQ(expected.size(), 10u);
  EXPECT_EQ(actual, expected) << result.errors().text();
}

TEST(ScenarioCorpus, EveryKindOfErrorHasItsFile) {
  std::vector<std::string> missing = {"type",   "unknown_key", "missing_key", "not_finite", "range",
                                      "syntax", "relation",    "duplicate",   "file"};
  for (const fs::path& file : files_of("invalid")) {
    std::istringstream head(lines_of(file).at(0));
    std::string hash, breaks, kind;
    head >> hash >> breaks >> kind;
    std::erase(missing, kind);
  }
  EXPECT_TRUE(missing.empty()) << missing.front();
}

}  // namespace
}  // namespace swallowtail::planner
