#include "tools/cli/cover_task.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "coverage/field/places.hpp"

namespace swallowtail::cli {
namespace {

std::string box(const std::string& id, int lo, int hi, const std::string& more = "") {
  const auto corner = [](int x, int y) { return "[" + std::to_string(x) + "," + std::to_string(y) + "]"; };
  const auto ring = [&](int a, int b) {
    return "[" + corner(a, a) + "," + corner(b, a) + "," + corner(b, b) + "," + corner(a, b) + "," +
           corner(a, a) + "]";
  };
  return R"({"type":"Feature","properties":{"crs":"local metres","id":")" + id + R"(")" + more +
         R"(},"geometry":{"type":"Polygon","coordinates":[)" + ring(lo, hi) +
         (id == "ring" ? "," + ring(lo + 50, hi - 50) : "") + "]}}";
}

Result<CoverJob> job_with(const std::string& features) {
  FieldsJob fields;
  fields.file = std::filesystem::temp_directory_path() /
                ("swallowtail_starts_" + std::to_string(getpid()) + ".geojson");
  std::ofstream(fields.file) << R"({"type":"FeatureCollection","features":[)" << features << "]}";
  Result<CoverJob> out = job_of(fields);
  std::filesystem::remove(fields.file);
  return out;
}

/// Nobody said where to start: that is never what a mission is refused for.
TEST(CoverTask, StartsWhereItMay) {
  const std::string zone = R"(,"no_fly":true)";
  for (const std::string& features :
       {box("inner", 80, 120) + "," + box("ring", 0, 200),
        box("barred", 0, 50) + "," + box("free", 100, 150) + "," + box("zone", -10, 60, zone),
        box("barred", 0, 50) + "," + box("zone", -10, 60, zone)}) {
    const auto job = job_with(features);
    ASSERT_TRUE(job.ok()) << job.error().message;
    ASSERT_EQ(job->tasks.size(), 1U);
    const coverage::Task& task = job->tasks.front();
    EXPECT_FALSE(coverage::barred_at(task.fields, task.no_fly, task.start_m.head<2>())) << features;
  }
}

}  // namespace
}  // namespace swallowtail::cli
