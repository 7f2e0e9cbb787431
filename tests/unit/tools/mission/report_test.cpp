#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tools/drawing/svg.hpp"
#include "tools/mission/report/chart.hpp"
#include "tools/mission/report/html.hpp"
#include "tools/mission/report/map.hpp"

namespace swallowtail::report {
namespace {

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST(Svg, NumbersAreShortAndFinite) {
  EXPECT_EQ(number(1.50), "1.5");
  EXPECT_EQ(number(-0.001, 1), "0");
  EXPECT_EQ(number(1200, 0), "1200");
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "–");
}

TEST(Svg, TextCannotBreakOut) {
  Svg svg(10, 10, "a<b>&\"c");
  svg.text(0, 0, "</text><script>");
  const std::string doc = svg.finish();
  EXPECT_EQ(doc.find("<script"), std::string::npos);
  EXPECT_NE(doc.find("a&lt;b&gt;&amp;&quot;c"), std::string::npos);
}

TEST(Chart, DrawsEverySeriesAndLevel) {
  const std::string svg = draw_chart("Battery", "units",
                                     {{"energy", "#111111", {{0, 100}, {10, 50}}, false},
                                      {"replans", "#222222", {{1, 2}, {3, 4}, {5, 6}}, true}},
                                     {{"reserve", 20, "#333333"}});
  EXPECT_EQ(count(svg, "<polyline"), 1U);
  EXPECT_EQ(count(svg, "<circle"), 3U);
  EXPECT_NE(svg.find("reserve"), std::string::npos);
}

TEST(Map, ShowsFieldsObstaclesAndFlight) {
  check::Rules rules;
  rules.fields = {{"north", 20.0, {{{0, 0}, {100, 0}, {100, 50}, {0, 50}}}}};
  check::Solid ball;
  ball.id = 5;
  ball.at = {50, 25, 20};
  ball.radius_m = 4;
  rules.solids = {ball};
  check::FlightLog log;
  for (int i = 0; i < 10; ++i) {
    data::VehicleState s;
    s.time_s = i;
    s.position = {10.0 * i, 5, 20};
    s.mode = data::VehicleMode::kCovering;
    log.states.push_back(s);
  }
  const std::string svg = draw_map(rules, log, "map");
  EXPECT_NE(svg.find("field north"), std::string::npos);
  EXPECT_NE(svg.find("obstacle 5"), std::string::npos);
  EXPECT_GE(count(svg, "<polyline"), 1U);
}

TEST(Page, StandsAlone) {
  const std::string html = draw_page({.title = "t",
                                      .verdict = "fine",
                                      .good = true,
                                      .facts = {{"covered", "99 %"}},
                                      .violations = {},
                                      .figures = {{"map.svg", "the map", "<svg/>"}},
                                      .footnote = "f"});
  EXPECT_EQ(html.find("http://"), std::string::npos);
  EXPECT_EQ(html.find("src="), std::string::npos);
  EXPECT_NE(html.find("99 %"), std::string::npos);
}

}  // namespace
}  // namespace swallowtail::report
