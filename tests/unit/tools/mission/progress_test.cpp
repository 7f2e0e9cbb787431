#include "tools/mission/run/progress.hpp"

#include <gtest/gtest.h>

namespace swallowtail::mission {
namespace {

TEST(Progress, ReadsWhatTheSimulatorPrints) {
  const auto p = parse_progress(
      R"({"time_s": 12.5, "covered_percent": 40.25, "energy": 88.0, "capacity": 100, "replans": 3, "state": "running", "mode": "covering", "unknown": []})");
  ASSERT_TRUE(p.has_value());
  EXPECT_DOUBLE_EQ(p->time_s, 12.5);
  EXPECT_EQ(p->replans, 3);
  EXPECT_EQ(p->mode, "covering");
  EXPECT_NE(progress_line(*p).find("40.2"), std::string::npos);
}

TEST(Progress, RefusesOtherLinesAndWrongTypes) {
  EXPECT_FALSE(parse_progress("hello").has_value());
  EXPECT_FALSE(parse_progress("[1,2]").has_value());
  const auto p = parse_progress(R"({"time_s": "soon", "mode": 7})");
  ASSERT_TRUE(p.has_value());
  EXPECT_DOUBLE_EQ(p->time_s, 0.0);
  EXPECT_EQ(p->mode, "");
}

}  // namespace
}  // namespace swallowtail::mission
