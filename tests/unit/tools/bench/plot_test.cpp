#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <limits>
#include <string>
#include <vector>

#include "tools/bench/plot/chart.hpp"
#include "tools/bench/plot/scene_view.hpp"

namespace swallowtail::bench {
namespace {

using ::testing::HasSubstr;

/// Empty: every tag that opens is closed, in order, and no number is missing; else what is wrong.
std::string flaw_in(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return "a tag without an end";
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return "unexpected <" + tag + ">";
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
  }
  if (!open.empty()) return "<" + open.back() + "> stays open";
  for (const char* word : {"nan", "inf\"", "–\""}) {
    if (xml.find(word) != std::string::npos) return std::string("holds ") + word;
  }
  return {};
}

TEST(Chart, IsWellFormedWhateverItIsGiven) {
  const double never = std::numeric_limits<double>::infinity();
  Chart chart{"gap & time", "ms", "%", Scale::kLog, Scale::kLog, {}};
  EXPECT_EQ(flaw_in(draw(chart)), "");
  chart.series.push_back({"<a>",
                          {{0.0, 1.0}, {1.0, never}, {2.0, 5.0}, {20.0, 0.5}},
                          {{1.0, 1.0}, {2.0, 1.0}},
                          {{1.0, 2.0}, {2.0, 3.0}},
                          false});
  chart.series.push_back({"b", {{3.0, 3.0}}, {}, {}, true});
  const std::string svg = draw(chart);
  EXPECT_EQ(flaw_in(svg), "");
  EXPECT_THAT(svg, HasSubstr("&lt;a&gt;"));
  EXPECT_THAT(svg, HasSubstr("<polyline"));
  EXPECT_THAT(svg, HasSubstr("fill-opacity=\"0.10\""));
  EXPECT_THAT(svg, HasSubstr("<circle"));
}

TEST(Chart, PutsLargerValuesHigherAndLaterOnesRight) {
  Chart chart{"t", "x", "y", Scale::kLinear, Scale::kLinear, {{"s", {{0, 0}, {10, 10}}, {}, {}, false}}};
  const std::string svg = draw(chart);
  const std::size_t at = svg.find("points=\"") + 8;
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  ASSERT_EQ(std::sscanf(svg.c_str() + at, "%lf,%lf %lf,%lf", &x0, &y0, &x1, &y1), 4);
  EXPECT_LT(x0, x1);
  EXPECT_GT(y0, y1);
}

TEST(Chart, GapsAreInPercentAndStayOnTheAxis) {
  const Series series = gap_series("s", {{1, 2}, {100, 100}, {110, 100}, {120, 101}}, 100.0);
  EXPECT_NEAR(series.points[0].second, 10.0, 1e-9);
  EXPECT_GT(series.points[1].second, 0.0);
  EXPECT_NEAR(series.upper[0].second, 20.0, 1e-9);
}

TEST(SceneView, DrawsEveryShapeAndThePaths) {
  using namespace planner;
  std::vector<Obstacle> obstacles(4);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    obstacles[i].id = static_cast<std::uint32_t>(i + 1);
    obstacles[i].position_m = Vec3(2.0 * static_cast<double>(i), 3, 2);
  }
  obstacles[0].shape = Sphere{1.0};
  obstacles[1].shape = Cylinder{1.0, 2.0};
  obstacles[2].shape = Cone{1.0, 2.0};
  obstacles[3].shape = Box{Vec3(1, 2, 3), 0.3};
  auto terrain = mountains_terrain({{5, 5, 3, 20}}, {0, 0}, {10, 10}, 1.0);
  ASSERT_TRUE(terrain);
  const auto world = World::make(*terrain, obstacles, {Vec3(0, 0, 0), Vec3(10, 10, 10)});
  ASSERT_TRUE(world);
  const std::string svg =
      draw_scene("a scene", **world, {{"ours", {Vec3(1, 1, 1), Vec3(5, 5, 6), Vec3(9, 9, 1)}}});
  EXPECT_EQ(flaw_in(svg), "");
  for (const char* tooltip : {"obstacle 1", "obstacle 2", "obstacle 4"}) EXPECT_THAT(svg, HasSubstr(tooltip));
  EXPECT_THAT(svg, HasSubstr("ours"));
}

}  // namespace
}  // namespace swallowtail::bench
