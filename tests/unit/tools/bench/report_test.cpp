#include "tools/bench/core/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

namespace swallowtail::bench {
namespace {

using ::testing::HasSubstr;

Report sample() {
  Report report;
  report.bench = "plan";
  report.status = "done";
  report.notes = {"one note"};
  report.rows = {{"a, \"quoted\"", "five", 3, "length", 15.5, "m"},
                 {"b", "five", 3, "time_to_1_percent", std::numeric_limits<double>::infinity(), "ms"}};
  report.tables = {{"five <spheres>", {"subject", "median"}, {{"a|b", "15.5"}, {"longer", "never"}}}};
  report.figures = {{"a figure", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>"}};
  report.extra["improved"] = true;
  return report;
}

const Environment kEnvironment{{"processor", "P"}, {"revision", "abc"}};

TEST(BenchReport, JsonHasTheStableFields) {
  const auto json = to_json(sample(), kEnvironment);
  EXPECT_EQ(json["environment"]["processor"], "P");
  ASSERT_EQ(json["rows"].size(), 2U);
  std::set<std::string> keys;
  for (const auto& [key, value] : json["rows"][0].items()) keys.insert(key);
  EXPECT_EQ(keys, (std::set<std::string>{"subject", "case", "seed", "metric", "value", "unit"}));
  EXPECT_DOUBLE_EQ(json["rows"][0]["value"].get<double>(), 15.5);
  EXPECT_TRUE(json["rows"][1]["value"].is_null());
  EXPECT_EQ(json["improved"], true);
}

TEST(BenchReport, CsvQuotesAndSaysNever) {
  const std::string csv = to_csv(sample(), kEnvironment);
  EXPECT_THAT(csv, HasSubstr("# revision: abc\n"));
  EXPECT_THAT(csv,
              HasSubstr("subject,case,seed,metric,value,unit\n\"a, \"\"quoted\"\"\",five,3,length,15.5,m\n"));
  EXPECT_THAT(csv, HasSubstr("b,five,3,time_to_1_percent,inf,ms\n"));
}

TEST(BenchReport, TablesKeepTheirShapeInEveryForm) {
  const Table table = sample().tables.front();
  EXPECT_EQ(to_text(table), "five <spheres>\n  subject  median\n  a|b        15.5\n  longer    never\n");
  EXPECT_THAT(to_markdown(table), HasSubstr("|---|---:|\n| a\\|b | 15.5 |\n"));
  const std::string html = to_html(sample(), kEnvironment);
  EXPECT_THAT(html, HasSubstr("five &lt;spheres&gt;"));
  EXPECT_THAT(html, HasSubstr("<figure>\n<svg"));
  EXPECT_THAT(html, Not(HasSubstr("src=")));
}

TEST(BenchReport, NumbersAreShort) {
  EXPECT_EQ(significant(15.684982), "15.68");
  EXPECT_EQ(significant(0.0012345), "0.001234");
  EXPECT_EQ(significant(123456.0), "123456");
  EXPECT_EQ(significant(1.5e9), "1.500e+09");
  EXPECT_EQ(significant(0.0), "0");
  EXPECT_EQ(significant(std::numeric_limits<double>::infinity()), "never");
}

TEST(Environment, NamesTheProcessorAndTheRevision) {
  EXPECT_EQ(processor_of("processor\t: 0\nmodel name\t: Some CPU @ 2 GHz\n"), "Some CPU @ 2 GHz");
  EXPECT_EQ(processor_of(""), "unknown");
  std::set<std::string> names;
  for (const auto& [name, value] : this_environment()) {
    names.insert(name);
    EXPECT_FALSE(value.empty()) << name;
  }
  for (const char* name : {"processor", "compiler", "version", "revision"}) EXPECT_TRUE(names.contains(name));
}

}  // namespace
}  // namespace swallowtail::bench
