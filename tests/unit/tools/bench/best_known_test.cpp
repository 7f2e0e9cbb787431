#include "tools/bench/core/best_known.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swallowtail::bench {
namespace {

constexpr const char* kText =
    "# lengths\n"
    "case,metric,value,unit,obtained\n"
    "five,length,15.6848,m,3000 starts, cross-checked\n";

TEST(BestKnown, ReadsAndWritesTheSame) {
  const auto file = BestKnownFile::parse(kText, "best.csv");
  ASSERT_TRUE(file) << file.error().message;
  const auto entry = file->find("five", "length");
  ASSERT_TRUE(entry);
  EXPECT_DOUBLE_EQ(entry->value, 15.6848);
  EXPECT_EQ(entry->obtained, "3000 starts, cross-checked");
  EXPECT_EQ(file->text(), kText);
  EXPECT_FALSE(file->find("six", "length"));
}

TEST(BestKnown, TakesWhatIsBetterOnly) {
  auto file = BestKnownFile::parse(kText, "best.csv");
  ASSERT_TRUE(file);
  EXPECT_FALSE(file->improve({"five", "length", 15.6848, "m", "again"}));
  EXPECT_FALSE(file->improve({"five", "length", 15.6848 * (1.0 - 1e-10), "m", "rounding"}));
  EXPECT_FALSE(file->improve({"five", "length", -1.0 / 0.0, "m", "no number"}));
  EXPECT_EQ(file->text(), kText);
  EXPECT_TRUE(file->improve({"five", "length", 15.6, "m", "found"}));
  EXPECT_DOUBLE_EQ(file->find("five", "length")->value, 15.6);
  EXPECT_EQ(file->find("five", "length")->obtained, "found");
  EXPECT_TRUE(file->improve({"ten", "length", 16.0, "m", "first"}));
  EXPECT_EQ(file->entries().size(), 2U);
}

TEST(BestKnown, RefusesWhatItCannotRead) {
  const auto message = [](const std::string& text) {
    const auto file = BestKnownFile::parse(text, "best.csv");
    return file ? std::string("accepted") : file.error().message;
  };
  EXPECT_THAT(message("case,value\n"), ::testing::HasSubstr("best.csv:1: must be"));
  EXPECT_THAT(message("case,metric,value,unit,obtained\na,b\n"),
              ::testing::HasSubstr("best.csv:2: must have"));
  EXPECT_THAT(message("case,metric,value,unit,obtained\na,b,12x,m,how\n"),
              ::testing::HasSubstr("finite number"));
  EXPECT_THAT(message("case,metric,value,unit,obtained\na,b,inf,m,how\n"),
              ::testing::HasSubstr("finite number"));
  EXPECT_THAT(message(std::string(kText) + "five,length,1,m,twice\n"), ::testing::HasSubstr("already"));
  EXPECT_FALSE(BestKnownFile::read("/nowhere/best.csv"));
}

}  // namespace
}  // namespace swallowtail::bench
