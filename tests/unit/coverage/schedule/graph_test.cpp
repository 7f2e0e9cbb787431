#include "coverage/schedule/graph.hpp"

#include <gtest/gtest.h>

#include <set>

#include "coverage/gtsp/check_tour.hpp"

namespace swallowtail::coverage {
namespace {

class Graph : public testing::Test {
 protected:
  std::vector<SubCell> row(int count, double apart_m, double rise_m = 0.0) const {
    std::vector<SubCell> out;
    for (int i = 0; i < count; ++i) {
      const double z = 20.0 + rise_m * i;
      out.push_back(
          {static_cast<std::uint32_t>(i), 1, Vec3(0, apart_m * i, z), Vec3(80, apart_m * i, z), 20.0, 10.0});
    }
    return out;
  }
  Result<LayeredGraph> build(const std::vector<SubCell>& cells, int neighbours, int levels,
                             double band_m = 0.0) {
    GraphParams params;
    params.neighbours = neighbours;
    params.levels = levels;
    params.height_band_m = band_m;
    return LayeredGraph::build(cells, start_, params, links_);
  }

  const planner::Terrain ground_ = planner::Terrain::flat(0.0);
  LinkCache links_{FlightModel({}, {}, ground_), Charger{}};
  ScheduleStart start_{
      .kind = StartKind::kGround, .position_m = Vec3::Zero(), .direction = {}, .energy = 500.0};
};

TEST_F(Graph, AClusterPerSubCellWithTwoSitesTimesLevels) {
  const auto graph = build(row(6, 10.0), 5, 10);
  ASSERT_TRUE(graph.ok()) << graph.error().message;
  EXPECT_EQ(graph->instance().vertex_count(), 1 + 6 * 20);
  EXPECT_EQ(graph->instance().cluster_count(), 7);
}

TEST_F(Graph, ATourDecodesToEachSubCellOnce) {
  const auto graph = build(row(6, 10.0), 5, 10);
  ASSERT_TRUE(graph.ok());
  gtsp::Options options;
  options.kind = gtsp::TourKind::kOpen;
  options.start_vertex = graph->start_vertex();
  const gtsp::Solution solution = gtsp::solve(graph->instance(), options);
  ASSERT_FALSE(solution.tour.empty()) << solution.reason;
  const auto judged =
      gtsp::check_tour(graph->instance(), solution.tour, {.returns_to_start = false, .start = 0});
  ASSERT_TRUE(judged.ok()) << judged.error().message;
  EXPECT_NEAR(*judged, solution.cost, 1e-6);
  std::set<std::size_t> seen;
  for (const Visit& visit : graph->decode(solution.tour)) seen.insert(visit.sub_cell);
  EXPECT_EQ(seen.size(), 6U);
}

TEST_F(Graph, PruningKeepsNeighboursAndWidensUntilConnected) {
  std::vector<SubCell> cells = row(5, 10.0, 3.0);
  for (SubCell cell : row(5, 10.0, 3.0)) {
    cell.id += 5;
    cell.alpha_m += Vec3(2000, 0, 100);
    cell.beta_m += Vec3(2000, 0, 100);
    cells.push_back(cell);
  }
  const auto graph = build(cells, 2, 1);
  ASSERT_TRUE(graph.ok());
  EXPECT_GT(graph->statistics().neighbours, 2) << "two groups far apart hang together by widening only";
  const auto full = build(cells, 9, 1);
  EXPECT_GT(full->statistics().edges, graph->statistics().edges);
}

TEST_F(Graph, TheHeightBandJoinsALayer) {
  const std::vector<SubCell> cells = row(12, 10.0, 1.0);
  const auto narrow = build(cells, 2, 1);
  const auto wide = build(cells, 2, 1, 100.0);
  EXPECT_GT(wide->statistics().edges, narrow->statistics().edges);
}

TEST_F(Graph, ASubCellTooLongForTheBatteryIsNamed) {
  std::vector<SubCell> cells = row(2, 10.0);
  cells[1].beta_m.x() = 1e5;
  const auto graph = build(cells, 5, 10);
  ASSERT_FALSE(graph.ok());
  EXPECT_NE(graph.error().message.find("Sub-cell 1"), std::string::npos);
}

}  // namespace
}  // namespace swallowtail::coverage
