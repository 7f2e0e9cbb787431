#include "coverage/field/swath.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swallowtail::coverage {
namespace {

constexpr double kWidth_m = 10.0;

/// A line from a to b, cut at shares of it, seen to half the width on both sides.
std::vector<SubCell> cut_line(const Vec2& a, const Vec2& b, const std::vector<double>& shares) {
  std::vector<SubCell> out;
  for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
    const Vec2 from = a + (b - a) * shares[i];
    const Vec2 to = a + (b - a) * shares[i + 1];
    SubCell cell;
    cell.alpha_m = Vec3(from.x(), from.y(), 20.0);
    cell.beta_m = Vec3(to.x(), to.y(), 20.0);
    cell.width_m = kWidth_m;
    out.push_back(cell);
  }
  return out;
}

const Polygon kAllRound{{{-200, -200}, {200, -200}, {200, 200}, {-200, 200}}, {}};

// GEOS' union off a grid lost the first swath here, 30 % of what is seen.
TEST(Swath, PiecesOfASlantedLineSeeWhatTheWholeLineSees) {
  const Vec2 a(-4.0, 15.0);
  const Vec2 b(-1.0, -36.0);
  const auto cells = cut_line(a, b, {0.0, 0.1, 0.3, 1.0});
  const auto area = swath_area(std::vector{kAllRound}, cells);
  ASSERT_TRUE(area);
  EXPECT_NEAR(area->covered_m2, (b - a).norm() * kWidth_m, 1e-3);
  EXPECT_NEAR(area->outside_m2, 0.0, 1e-3);
  const std::vector<Polygon> whole = {{swath_of(cut_line(a, b, {0.0, 1.0}).front()), {}}};
  EXPECT_LT(largest_gap(whole, cells).value_or(Gap{}).area_m2, 1e-3);
}

TEST(Swath, LinesSideBySideAtAnySlantSeeWhatTheyAreWide) {
  for (int degree = 0; degree < 180; ++degree) {
    SCOPED_TRACE(degree);
    const double slant_rad = degree * 0.0174532925;
    const Vec2 along(std::cos(slant_rad), std::sin(slant_rad));
    const Vec2 across = Vec2(-along.y(), along.x()) * kWidth_m;
    std::vector<SubCell> cells;
    for (int line = 0; line < 4; ++line) {
      const Vec2 from = along * -30.0 + across * line;
      const auto pieces = cut_line(from, from + along * 80.0, {0.0, 0.1 + 0.1 * line, 0.6, 0.7, 1.0});
      cells.insert(cells.end(), pieces.begin(), pieces.end());
    }
    const auto area = swath_area(std::vector{kAllRound}, cells);
    ASSERT_TRUE(area);
    EXPECT_NEAR(area->covered_m2, 4.0 * 80.0 * kWidth_m, 1e-2);
  }
}

}  // namespace
}  // namespace swallowtail::coverage
