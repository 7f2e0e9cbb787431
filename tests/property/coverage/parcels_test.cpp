// Real parcels, judged point by point. The data are not part of the project: SWALLOWTAIL_DATA names their
// folder, else ../shared/data beside the project; where they are missing the test is skipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "coverage/field/geojson.hpp"
#include "coverage/field/sub_cells.hpp"
#include "tests/support/cover_oracle.hpp"

namespace swallowtail::coverage {
namespace {

std::string data_file(const std::string& name) {
  const char* named = std::getenv("SWALLOWTAIL_DATA");
  const std::filesystem::path folder =
      named != nullptr ? named : std::string(SWALLOWTAIL_SOURCE_DIR) + "/../shared/data";
  return (folder / "fields" / name).string();
}

test_support::Ground ground_of(const Polygon& polygon) {
  test_support::Ground out;
  const auto add = [&](const Ring& ring) {
    out.rings.emplace_back();
    for (const Vec2& p : ring) out.rings.back().emplace_back(p.x(), p.y());
  };
  add(polygon.outline);
  for (const Ring& hole : polygon.holes) add(hole);
  return out;
}

class Parcels : public testing::TestWithParam<const char*> {};

TEST_P(Parcels, AreCoveredFromInsideOrRefusedForATrueReason) {
  const std::string path = data_file(GetParam());
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there (set SWALLOWTAIL_DATA)";
  const auto file = read_fields(path, {.frame = FieldFrame::kPerField});
  ASSERT_TRUE(file.ok()) << file.error().message;
  for (const Field& field : file->fields) {
    SCOPED_TRACE(field.name);
    const FieldCut cut = cut_field(field, planner::Terrain::flat(0.0), {});
    if (cut.status == FieldStatus::kRefused) {
      for (const Vec2& a : field.polygon.outline) {
        for (const Vec2& b : field.polygon.outline)
          EXPECT_LT((a - b).norm(), 10.0) << "only what the sensor is wider than: " << cut.reason;
      }
      continue;
    }
    std::vector<test_support::FlownLine> lines;
    for (const SubCell& cell : cut.sub_cells)
      lines.push_back({{cell.alpha_m.x(), cell.alpha_m.y()}, {cell.beta_m.x(), cell.beta_m.y()}});
    const auto verdict = test_support::judge_cover(
        ground_of(field.polygon), lines,
        {.width_m = 10.0, .cell_m = std::clamp(std::sqrt(cut.area_m2) / 500.0, 0.05, 1.0), .step_m = 0.5});
    EXPECT_GE(verdict.covered_share, 0.999);
    EXPECT_EQ(verdict.outside_m, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Parcels,
                         testing::Values("nl.geojson", "dk.geojson", "at.geojson", "nz.geojson",
                                         "jecam.geojson"));

}  // namespace
}  // namespace swallowtail::coverage
