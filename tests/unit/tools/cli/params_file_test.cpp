#include "tools/cli/params_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace swallowtail::cli {
namespace {

Result<ChosenParams> read(const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      (std::string("swallowtail_params_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() +
       ".json");
  std::ofstream(file) << text;
  Result<ChosenParams> chosen = read_params(file.string());
  std::filesystem::remove(file);
  return chosen;
}

TEST(ParamsFile, ReadsWhatTuneWrites) {
  const Result<ChosenParams> chosen =
      read(R"({"status": "tuned", "algorithm": "pso", "midpoints": 4, "generations": 33,
               "parameters": {"population": 12, "jump": 0.9}, "sweep": []})");
  ASSERT_TRUE(chosen.ok());
  EXPECT_EQ(chosen->algorithm, "pso");
  EXPECT_EQ(chosen->midpoints, 4);
  EXPECT_EQ(chosen->settings, (swarm::Settings{{"jump", 0.9}, {"population", 12.0}}));
}

TEST(ParamsFile, WhatIsNotThereKeepsItsDefault) {
  const Result<ChosenParams> chosen = read("{}");
  ASSERT_TRUE(chosen.ok());
  EXPECT_TRUE(chosen->algorithm.empty());
  EXPECT_FALSE(chosen->midpoints.has_value());
  EXPECT_TRUE(chosen->settings.empty());
}

TEST(ParamsFile, RefusesWhatIsNoDocumentOfParameters) {
  for (const char* text :
       {"", "[1]", "{", R"({"algorithm": 3})", R"({"midpoints": 0})", R"({"midpoints": 65})",
        R"({"midpoints": 2.5})", R"({"midpoints": "4"})", R"({"parameters": [1]})",
        R"({"parameters": {"population": "many"}})", R"({"parameters": {"jump": null}})"}) {
    const Result<ChosenParams> chosen = read(text);
    ASSERT_FALSE(chosen.ok()) << text;
    EXPECT_EQ(chosen.error().code, Error::Code::kBadInput) << text;
  }
  EXPECT_FALSE(read_params("/nowhere/params.json").ok());
}

TEST(ParamsFile, ASettingIsAKeyAndANumber) {
  EXPECT_EQ(parse_setting("jump=0.5").value(), (std::pair<std::string, double>("jump", 0.5)));
  EXPECT_EQ(parse_setting("x=-1e3").value().second, -1000.0);
  for (const char* text :
       {"", "=", "jump", "jump=", "=3", "jump=high", "jump=1 ", "jump=nan", "jump=inf", "a=1=2"}) {
    EXPECT_FALSE(parse_setting(text).ok()) << text;
  }
}

}  // namespace
}  // namespace swallowtail::cli
