#include "coverage/gtsp/instance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace swallowtail::gtsp {
namespace {

using testing::HasSubstr;

TEST(Instance, SparseKnowsItsArcsAndNoOthers) {
  const std::vector<ArcInput> arcs = {{0, 2, 5.0}, {0, 1, 3.0}, {2, 0, 1.5}};
  const Result<Instance> instance = Instance::from_arcs(3, {{0}, {1, 2}}, arcs);
  ASSERT_TRUE(instance.ok());
  EXPECT_EQ(instance->cost(0, 1), 3.0);
  EXPECT_EQ(instance->cost(2, 0), 1.5);
  EXPECT_EQ(instance->cost(1, 0), kNoArc);
  EXPECT_EQ(instance->cost(1, 1), kNoArc);
  EXPECT_EQ(instance->cluster_of(2), 1);
  std::vector<int> targets;
  for (const Arc arc : instance->arcs_from(0)) targets.push_back(arc.to);
  EXPECT_EQ(targets, (std::vector<int>{1, 2}));
}

TEST(Instance, KeepsTheCheapestOfParallelArcs) {
  const std::vector<ArcInput> arcs = {{0, 1, 5.0}, {0, 1, 2.0}, {0, 1, 9.0}, {1, 0, 1.0}};
  const Result<Instance> instance = Instance::from_arcs(2, {{0}, {1}}, arcs);
  ASSERT_TRUE(instance.ok());
  EXPECT_EQ(instance->cost(0, 1), 2.0);
  EXPECT_EQ(instance->cost(1, 0), 1.0);
}

TEST(Instance, RowsAreTheArcsAsTheyAreKept) {
  const Result<Instance> instance =
      Instance::from_rows({{0}, {1, 2}}, {0, 2, 2, 3}, {{1, 3.0}, {2, 5.0}, {0, 1.5}});
  ASSERT_TRUE(instance.ok());
  EXPECT_EQ(instance->vertex_count(), 3);
  EXPECT_EQ(instance->cost(0, 2), 5.0);
  EXPECT_EQ(instance->cost(2, 0), 1.5);
  EXPECT_EQ(instance->cost(1, 0), kNoArc);
  const auto refused = [](std::vector<std::size_t> first_arc, std::vector<Arc> arcs) {
    const auto out = Instance::from_rows({{0}, {1, 2}}, std::move(first_arc), std::move(arcs));
    return out.ok() ? std::string() : out.error().message;
  };
  EXPECT_THAT(refused({0, 2, 2, 2}, {{2, 5.0}, {1, 3.0}}), HasSubstr("Arc 0 -> 1 stands behind"));
  EXPECT_THAT(refused({0, 2, 2, 2}, {{1, 5.0}, {1, 3.0}}), HasSubstr("Arc 0 -> 1 stands behind"));
  EXPECT_THAT(refused({0, 1, 1, 1}, {{3, 5.0}}), HasSubstr("outside 0 to 2"));
  EXPECT_THAT(refused({0, 1, 1, 1}, {{1, -5.0}}), HasSubstr("cost"));
  EXPECT_THAT(refused({0, 2, 1, 1}, {{1, 5.0}}), HasSubstr("rows"));
  EXPECT_THAT(refused({0, 0, 0, 0}, {{1, 5.0}}), HasSubstr("rows"));
  EXPECT_THAT(refused({}, {}), HasSubstr("rows"));
}

TEST(Instance, MatrixIteratesOverExistingArcs) {
  const Result<Instance> instance =
      Instance::from_matrix(3, {{0}, {1}, {2}}, {7, 1, kNoArc, 2, 7, 3, kNoArc, kNoArc, 7});
  ASSERT_TRUE(instance.ok());
  int count = 0;
  for (const Arc arc : instance->arcs_from(0)) {
    EXPECT_EQ(arc.to, 1);
    ++count;
  }
  EXPECT_EQ(count, 1);
  EXPECT_EQ(instance->cost(0, 0), kNoArc);
  EXPECT_EQ(instance->arcs_from(2).begin(), instance->arcs_from(2).end());
}

TEST(Instance, PointsRoundAsTsplibSays) {
  const auto between = [](Point a, Point b, Metric metric) {
    return Instance::from_points({{0}, {1}}, {a, b}, metric).value().cost(0, 1);
  };
  EXPECT_EQ(between({0, 0}, {1, 1}, Metric::kEuc2D), 1.0);
  EXPECT_EQ(between({0, 0}, {1, 1}, Metric::kCeil2D), 2.0);
  EXPECT_EQ(between({0, 0}, {10, 0}, Metric::kAtt), 4.0);
  EXPECT_EQ(between({0, 0}, {0, 90}, Metric::kGeo), 10020.0);
  EXPECT_EQ(between({0, 0}, {0, 90}, Metric::kGeom), std::floor(6378388.0 * M_PI / 2.0 + 1.0));
}

TEST(Instance, RefusesWhatIsNotAnInstance) {
  const auto refusal = [](int n, Instance::Clusters clusters, std::vector<ArcInput> arcs) {
    const auto instance = Instance::from_arcs(n, std::move(clusters), arcs);
    return instance.ok() ? std::string("accepted") : instance.error().message;
  };
  EXPECT_THAT(refusal(0, {}, {}), HasSubstr("0 vertices"));
  EXPECT_THAT(refusal(2, {{0, 1}, {}}, {}), HasSubstr("Cluster 1 is empty"));
  EXPECT_THAT(refusal(2, {{0}}, {}), HasSubstr("Vertex 1 is in no cluster"));
  EXPECT_THAT(refusal(2, {{0}, {1, 0}}, {}), HasSubstr("Vertex 0 of cluster 1 is also in cluster 0"));
  EXPECT_THAT(refusal(2, {{0}, {2}}, {}), HasSubstr("Vertex 2 of cluster 1 is outside"));
  EXPECT_THAT(refusal(2, {{0}, {1}}, {{0, 5, 1.0}}), HasSubstr("Arc 0 -> 5"));
  EXPECT_THAT(refusal(2, {{0}, {1}}, {{-1, 0, 1.0}}), HasSubstr("Arc -1 -> 0"));
  EXPECT_THAT(refusal(2, {{0}, {1}}, {{1, 1, 1.0}}), HasSubstr("itself"));
  EXPECT_THAT(refusal(2, {{0}, {1}}, {{0, 1, -1.0}}), HasSubstr("Arc 0 -> 1 has cost -1"));
  EXPECT_THAT(refusal(2, {{0}, {1}}, {{0, 1, NAN}}), HasSubstr("nan"));
  EXPECT_THAT(refusal(2, {{0}, {1}}, {{0, 1, INFINITY}}), HasSubstr("inf"));
  EXPECT_THAT(refusal(-3, {{0}}, {}), HasSubstr("-3 vertices"));
}

TEST(Instance, RefusesBadMatricesAndPoints) {
  EXPECT_FALSE(Instance::from_matrix(2, {{0}, {1}}, {0, 1, 1}).ok());
  EXPECT_FALSE(Instance::from_matrix(2, {{0}, {1}}, {0, NAN, 1, 0}).ok());
  EXPECT_FALSE(Instance::from_matrix(2, {{0}, {1}}, {0, -2, 1, 0}).ok());
  EXPECT_FALSE(Instance::from_matrix(kMaxMatrixVertices + 1, {{0}}, {}).ok());
  EXPECT_FALSE(Instance::from_points({{0}, {1}}, {{0, 0}, {NAN, 0}}, Metric::kEuc2D).ok());
  EXPECT_FALSE(Instance::from_points({{0}, {1}}, {{0, 0}, {1e30, 0}}, Metric::kEuc2D).ok());
  EXPECT_FALSE(Instance::from_points({{0}, {1}}, {{0, 0}}, Metric::kEuc2D).ok());
}

}  // namespace
}  // namespace swallowtail::gtsp
