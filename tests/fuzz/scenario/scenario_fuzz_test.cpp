// Valid scenario files with random damage: the reader must end, give a scenario or errors that say something,
// and never crash. Run it under the sanitizers.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "planner/base/rng.hpp"
#include "planner/scenario/read.hpp"
#include "planner/scenario/timeline.hpp"

namespace swallowtail::planner {
namespace {

namespace fs = std::filesystem;

const fs::path kData = fs::path(SWALLOWTAIL_SOURCE_DIR) / "tests/data";

std::vector<std::string> texts_of(std::initializer_list<const char*> folders) {
  std::vector<fs::path> files;
  for (const char* folder : folders) {
    for (const auto& entry : fs::directory_iterator(kData / folder)) {
      if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  std::vector<std::string> texts;
  for (const fs::path& file : files) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    texts.push_back(text.str());
  }
  return texts;
}

const std::vector<std::string> kFragments = {"- ",
                                             ": ",
                                             "{",
                                             "}",
                                             "[",
                                             "]",
                                             "\n",
                                             "  ",
                                             "\"",
                                             "'",
                                             "#",
                                             "&a ",
                                             "*a",
                                             "!!int ",
                                             "|\n",
                                             ">\n",
                                             "? ",
                                             "---\n",
                                             "...",
                                             ".nan",
                                             "-.inf",
                                             "1e999",
                                             "-1e999",
                                             "0x1",
                                             "~",
                                             "null",
                                             "true",
                                             "\t",
                                             "\\",
                                             "\xff",
                                             "\xc3",
                                             "%Y ",
                                             "<<: ",
                                             "id",
                                             "obstacles",
                                             "events: ",
                                             "at_s: 1e300",
                                             "4294967296",
                                             "-0",
                                             "1e-320",
                                             "99999999999999999999",
                                             ",",
                                             "[[[[[[[[",
                                             "{{{{{{{{"};

std::string damaged(std::string text, const std::vector<std::string>& all, Rng& rng) {
  const std::uint64_t count = 1 + rng.below(3);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::size_t at = text.empty() ? 0 : static_cast<std::size_t>(rng.below(text.size()));
    const std::size_t length = static_cast<std::size_t>(rng.below(30));
    switch (rng.below(6)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, kFragments[rng.below(kFragments.size())]);
        break;
      case 2:
        if (!text.empty()) text[at] = static_cast<char>(rng.below(256));
        break;
      case 3:
        text.insert(at, text.substr(at, length * 4));
        break;
      case 4:
        text.resize(at);
        break;
      default: {
        const std::string& other = all[rng.below(all.size())];
        const std::size_t from = static_cast<std::size_t>(rng.below(other.size()));
        text.replace(at, length, other.substr(from, length));
      }
    }
  }
  return text;
}

TEST(ScenarioFuzz, DamagedFilesGiveAScenarioOrErrors) {
  const std::vector<std::string> valid = texts_of({"scenarios/valid", "missions"});
  const std::vector<std::string> all = texts_of({"scenarios/valid", "scenarios/invalid", "missions"});
  ASSERT_GT(all.size(), 50u);
  const char* wanted = std::getenv("SWALLOWTAIL_FUZZ_RUNS");
  const int runs = wanted != nullptr ? std::atoi(wanted) : 20'000;
  int accepted = 0;
  for (int run = 0; run < runs; ++run) {
    Rng rng(static_cast<std::uint64_t>(run));
    SCOPED_TRACE("seed " + std::to_string(run));
    const std::string text = damaged(valid[rng.below(valid.size())], all, rng);
    const ScenarioResult result = parse_scenario(text, "fuzz.yaml", (kData / "missions").string());
    if (result.ok()) {
      ++accepted;
      for (const Obstacle& obstacle : obstacles_at(result.value(), 1e6)) ASSERT_TRUE(validate(obstacle).ok());
      ASSERT_TRUE((result->bounds.min_m.array() < result->bounds.max_m.array()).all());
      continue;
    }
    ASSERT_FALSE(result.errors().errors.empty());
    int line = 0;
    for (const ScenarioError& error : result.errors().errors) {
      ASSERT_FALSE(error.rule.empty());
      ASSERT_GE(error.line, line) << result.errors().text();
      line = error.line;
    }
  }
  EXPECT_GT(accepted, runs / 200) << "the damage leaves nothing to accept";
  EXPECT_LT(accepted, runs) << "the damage does none";
}

}  // namespace
}  // namespace swallowtail::planner
