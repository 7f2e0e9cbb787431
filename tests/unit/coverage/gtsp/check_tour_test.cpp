#include "coverage/gtsp/check_tour.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swallowtail::gtsp {
namespace {

/// Clusters {0, 1}, {2}, {3}; arcs 0→2→3→0 of 1, 2, 4.
Instance triangle() {
  const std::vector<ArcInput> arcs = {{0, 2, 1.0}, {2, 3, 2.0}, {3, 0, 4.0}};
  return Instance::from_arcs(4, {{0, 1}, {2}, {3}}, arcs).value();
}

std::string refusal(const std::vector<int>& tour, const TourRule& rule) {
  const auto cost = check_tour(triangle(), tour, rule);
  return cost.ok() ? "accepted" : cost.error().message;
}

TEST(CheckTour, SumsTheArcs) {
  EXPECT_EQ(check_tour(triangle(), std::vector<int>{0, 2, 3}, {}).value(), 7.0);
  EXPECT_EQ(check_tour(triangle(), std::vector<int>{0, 2, 3}, {.returns_to_start = false}).value(), 3.0);
  EXPECT_EQ(
      check_tour(triangle(), std::vector<int>{2, 3, 0}, {.prefix = {2, 3}, .start = 2, .end = 0}).value(),
      7.0);
}

TEST(CheckTour, RefusesEveryBreach) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal({}, {}), HasSubstr("Cluster 0 is visited 0 times"));
  EXPECT_THAT(refusal({0, 2}, {}), HasSubstr("Cluster 2 is visited 0 times"));
  EXPECT_THAT(refusal({0, 1, 2, 3}, {}), HasSubstr("Cluster 0 is visited 2 times"));
  EXPECT_THAT(refusal({0, 2, 9}, {}), HasSubstr("vertex 9"));
  EXPECT_THAT(refusal({0, 3, 2}, {}), HasSubstr("arc 0 -> 3"));
  EXPECT_THAT(refusal({0, 2, 3}, {.prefix = {0, 3}}), HasSubstr("Vertex 3"));
  EXPECT_THAT(refusal({0, 2, 3}, {.start = 2}), HasSubstr("start at vertex 2"));
  EXPECT_THAT(refusal({0, 2, 3}, {.end = 2}), HasSubstr("end at vertex 2"));
}

}  // namespace
}  // namespace swallowtail::gtsp
