#include "tools/cli/output.hpp"

#include <filesystem>

#include <unistd.h>

#include <gtest/gtest.h>

#include "tools/cli/statistics.hpp"

namespace swallowtail::cli {
namespace {

/// A file name of this process's own; removed with the object.
struct ScratchFile {
  explicit ScratchFile(const std::string& extension)
      : path((std::filesystem::temp_directory_path() /
              ("swallowtail_cli_" + std::to_string(getpid()) + extension))
                 .string()) {}
  ~ScratchFile() { std::filesystem::remove(path); }
  std::string path;
};

TEST(Output, ExtensionChoosesTheFormat) {
  Answer answer{{{"status", "certified"}}, "table\n", {{".csv", [] { return std::string("a,b\n"); }}}};
  for (const auto& [extension, text] :
       {std::pair{".csv", "a,b\n"}, std::pair{".json", "{\n \"status\": \"certified\"\n}\n"}}) {
    const ScratchFile file(extension);
    Common common;
    common.quiet = true;
    common.output = file.path;
    EXPECT_EQ(deliver(common, answer, Exit::kDone), Exit::kDone);
    EXPECT_EQ(read_text(file.path, 1000).value(), text);
  }
}

TEST(Output, AFileThatCannotBeWrittenIsAnError) {
  Common common;
  common.quiet = true;
  common.output = "/nowhere/at/all.json";
  EXPECT_EQ(deliver(common, {}, Exit::kDone), Exit::kUsage);
}

TEST(Output, UnknownExtensionsAreRefusedBeforeTheWork) {
  Common common;
  common.output = "plan.doc";
  const Status status = check_output(common, {".json", ".csv"});
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message, "-o plan.doc: the extension must be one of .json, .csv.");
  common.output = "plan.csv";
  EXPECT_TRUE(check_output(common, {".json", ".csv"}).ok());
}

TEST(Output, LargeFilesAreNotRead) {
  const ScratchFile file(".txt");
  ASSERT_TRUE(write_text(file.path, std::string(101, 'x')).ok());
  EXPECT_FALSE(read_text(file.path, 100).ok());
  EXPECT_TRUE(read_text(file.path, 101).ok());
}

TEST(Output, ErrorsHaveTheirExitCodes) {
  EXPECT_EQ(fail(bad_input("test")), Exit::kUsage);
  EXPECT_EQ(fail(not_found("test")), Exit::kUsage);
  EXPECT_EQ(fail(infeasible("test")), Exit::kNone);
  EXPECT_EQ(fail({Error::Code::kInterrupted, "test"}), Exit::kInterrupted);
  EXPECT_EQ(fail(internal_error("test")), Exit::kInternal);
}

TEST(Statistics, SpreadOfAListInAnyOrder) {
  const Spread odd = spread_of({3, 1, 8});
  EXPECT_EQ(odd.min, 1);
  EXPECT_EQ(odd.median, 3);
  EXPECT_EQ(odd.mean, 4);
  EXPECT_EQ(odd.max, 8);
  EXPECT_EQ(spread_of({4, 1, 2, 3}).median, 2.5);
  EXPECT_TRUE(spread_json({}).is_null());
}

}  // namespace
}  // namespace swallowtail::cli
