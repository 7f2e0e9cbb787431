// The bench as a user runs it: exit codes, documents, files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct Ran {
  int exit = -1;
  std::string out;
};

Ran run(const std::string& command) {
  Ran ran;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return ran;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    ran.out.append(buffer.data(), n);
  const int status = pclose(pipe);
  ran.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return ran;
}

const std::string kBench = SWALLOWTAIL_BENCH_PROGRAM;
const std::string kMain = SWALLOWTAIL_PROGRAM;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void expect_rows(const nlohmann::json& document) {
  for (const char* key : {"processor", "compiler", "version", "revision"})
    EXPECT_TRUE(document.at("environment").contains(key)) << key;
  ASSERT_FALSE(document.at("rows").empty());
  for (const auto& row : document.at("rows")) {
    ASSERT_EQ(row.size(), 6U);
    EXPECT_TRUE(row.at("subject").is_string() && row.at("case").is_string() && row.at("metric").is_string());
    EXPECT_TRUE(row.at("seed").is_number_unsigned() && row.at("unit").is_string());
    EXPECT_TRUE(row.at("value").is_number() || row.at("value").is_null());
  }
}

TEST(BenchProgram, PlansQuicklyThroughTheMainCommand) {
  const fs::path html = fs::temp_directory_path() / ("bench_" + std::to_string(getpid()) + ".html");
  const Ran ran = run(kMain + " bench plan --quick --json -o " + html.string());
  ASSERT_EQ(ran.exit, 0) << ran.out;
  const auto document = nlohmann::json::parse(ran.out);
  EXPECT_EQ(document.at("bench"), "plan");
  EXPECT_EQ(document.at("status"), "done");
  expect_rows(document);
  EXPECT_THAT(text_of(html), HasSubstr("<svg"));
  fs::remove(html);
}

TEST(BenchProgram, ReproducesADocumentQuickly) {
  const fs::path csv = fs::temp_directory_path() / ("bench_" + std::to_string(getpid()) + ".csv");
  const Ran ran = run(kBench + " seeds pso_five --quick --json -o " + csv.string());
  ASSERT_EQ(ran.exit, 0) << ran.out;
  const auto document = nlohmann::json::parse(ran.out);
  expect_rows(document);
  ASSERT_FALSE(document.at("claims").empty());
  for (const auto& claim : document.at("claims")) {
    EXPECT_THAT(claim.at("verdict").get<std::string>(),
                ::testing::AnyOf("reproduced", "not reproduced", "not decidable"));
  }
  EXPECT_THAT(text_of(csv), HasSubstr("subject,case,seed,metric,value,unit\n"));
  fs::remove(csv);
}

TEST(BenchProgram, MeasuresCoverageQuickly) {
  const Ran ran = run(kBench + " cover parcels --quick --quiet --json");
  ASSERT_EQ(ran.exit, 0) << ran.out;
  const auto document = nlohmann::json::parse(ran.out);
  EXPECT_EQ(document.at("bench"), "cover");
  expect_rows(document);
}

TEST(BenchProgram, AblationAndInvarianceRun) {
  const Ran ablation = run(kBench + " plan five_spheres --ablation --quick --json");
  ASSERT_EQ(ablation.exit, 0) << ablation.out;
  EXPECT_THAT(ablation.out, HasSubstr("without butterflies"));
  const Ran invariance = run(kBench + " plan --invariance --quick --only boa --json");
  ASSERT_EQ(invariance.exit, 0) << invariance.out;
  EXPECT_TRUE(nlohmann::json::parse(invariance.out).at("invariant").is_boolean());
}

TEST(BenchProgram, RefusesWhatIsWrongWithExitCodeTwo) {
  const auto refused = [](const std::string& words, const std::string& because) {
    const Ran ran = run(kBench + " " + words);
    EXPECT_EQ(ran.exit, 2) << words;
    EXPECT_THAT(ran.out, HasSubstr(because)) << words;
  };
  refused("", "subcommand is required");
  refused("plan no_such_scene --quick", "no_such_scene");
  refused("plan --quick --only nobody", "There is no subject 'nobody'");
  refused("plan --quick -o table.xls", "extension");
  refused("plan --quick --data /nowhere", "/nowhere");
  refused("cover clouds", "clouds");
  refused("cover parcels --quick --fields /nowhere", "/nowhere");
  refused("seeds nothing", "There is no experiment 'nothing'");
  refused("plan --runs 0", "runs");
  refused("scene clouds", "clouds");
}

TEST(BenchProgram, HelpsWithExamples) {
  for (const char* command : {"plan", "seeds", "scene", "cover"}) {
    const Ran ran = run(kBench + " " + command + " --help");
    EXPECT_EQ(ran.exit, 0);
    EXPECT_THAT(ran.out, HasSubstr("Examples:")) << command;
  }
  EXPECT_THAT(run(kMain + " bench plan --help").out, HasSubstr("Examples:"));
}

TEST(BenchProgram, SaysWhenItWasNotBuilt) {
  const fs::path alone = fs::temp_directory_path() / ("bench_alone_" + std::to_string(getpid()));
  fs::create_directory(alone);
  fs::copy_file(kMain, alone / "swallowtail");
  const Ran ran = run((alone / "swallowtail").string() + " bench plan");
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.out, HasSubstr("was not built"));
  fs::remove_all(alone);
}

}  // namespace
