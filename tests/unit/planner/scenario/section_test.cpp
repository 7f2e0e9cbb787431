#include "planner/scenario/detail/section.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace swallowtail::planner::detail {
namespace {

struct Fixture {
  explicit Fixture(const std::string& text)
      : tree(parse_raw_tree(text)), log("f.yaml"), top(tree.root, "", log) {}
  std::string only_error() {
    const ScenarioErrors errors = log.take();
    return errors.errors.size() == 1 ? errors.errors[0].text() : "not one error but:\n" + errors.text();
  }
  RawTree tree;
  ErrorLog log;
  Section top;
};

TEST(Section, MessageNamesFileLineKeyValueAndRule) {
  Fixture f("a: 1\nwidth_m: -4\n");
  double width_m = 7.0;
  EXPECT_FALSE(f.top.number("width_m", Need::kRequired, above_to(0, 10), width_m));
  EXPECT_EQ(width_m, 7.0);
  EXPECT_EQ(f.only_error(), "f.yaml:2: width_m: -4: must be a number above 0 and at most 10");
}

TEST(Section, ReadsNumbersAsYamlWritesThem) {
  const std::pair<const char*, double> cases[] = {{"1", 1},          {"-2.5", -2.5}, {"+3", 3}, {"1e3", 1000},
                                                  {"1.5E-2", 0.015}, {".5", 0.5},    {"5.", 5}};
  for (const auto& [text, value] : cases) {
    Fixture f(std::string("v: ") + text);
    double out = 0;
    EXPECT_TRUE(f.top.number("v", Need::kRequired, Range{}, out)) << text;
    EXPECT_EQ(out, value);
  }
  for (const char* text : {"0x10", "1_000", "1,5", "--1", "+-1", "++1", "+", "1 m", "nan", "-.inf", "1e999",
                           "[1]", "{}", "~", "\"1\"", "true"}) {
    Fixture f(std::string("v: ") + text);
    double out = 0;
    EXPECT_FALSE(f.top.number("v", Need::kRequired, Range{}, out)) << text;
    EXPECT_EQ(f.log.take().errors.size(), 1u) << text;
  }
}

TEST(Section, NamesTheRightUnit) {
  Fixture f("speed_kmh: 4\n");
  double speed = 0;
  f.top.number("speed_mps", Need::kOptional, Range{}, speed);
  f.top.finish();
  EXPECT_EQ(f.only_error(),
            "f.yaml:1: speed_kmh: 4: is an unknown key: wrong or missing unit, it is speed_mps");
}

TEST(Section, GuessesWhatAMisspeltKeyMeans) {
  Fixture f("nmae: x\n");
  std::string name;
  f.top.text("name", Need::kOptional, name);
  f.top.finish();
  EXPECT_EQ(f.only_error(), "f.yaml:1: nmae: x: is an unknown key; name is meant?");
}

TEST(Section, AnglesBecomeRadians) {
  Fixture f("turn_deg: 90\n");
  double turn_rad = 0;
  EXPECT_TRUE(f.top.angle_deg("turn_deg", Need::kRequired, from_to(0, 180), turn_rad));
  EXPECT_DOUBLE_EQ(turn_rad, std::numbers::pi / 2);
}

TEST(Section, WholeNumbersStayWithinTheirRange) {
  Fixture f("a: 2.5\nb: 4294967296\nc: 4294967295\n");
  std::uint32_t out = 0;
  EXPECT_FALSE(f.top.integer("a", Need::kRequired, from_to(0, 10), out));
  EXPECT_FALSE(f.top.integer("b", Need::kRequired, from_to(0, 4294967295.0), out));
  EXPECT_TRUE(f.top.integer("c", Need::kRequired, from_to(0, 4294967295.0), out));
  EXPECT_EQ(out, 4294967295u);
}

TEST(Section, TextThatLooksLikeAnotherTypeNeedsQuotes) {
  Fixture f("a: 12\nb: true\nc: \"12\"\nd: .inf\n");
  std::string out;
  EXPECT_FALSE(f.top.text("a", Need::kRequired, out));
  EXPECT_FALSE(f.top.text("b", Need::kRequired, out));
  EXPECT_FALSE(f.top.text("d", Need::kRequired, out));
  EXPECT_TRUE(f.top.text("c", Need::kRequired, out));
  EXPECT_EQ(out, "12");
}

TEST(Section, ErrorsComeInTheOrderOfLines) {
  Fixture f("b: x\na: y\n");
  double out = 0;
  f.top.number("a", Need::kRequired, Range{}, out);
  f.top.number("b", Need::kRequired, Range{}, out);
  const ScenarioErrors errors = f.log.take();
  ASSERT_EQ(errors.errors.size(), 2u);
  EXPECT_EQ(errors.errors[0].key, "b");
}

}  // namespace
}  // namespace swallowtail::planner::detail
