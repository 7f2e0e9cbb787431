#include "tools/cli/cover_files.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/cli/geojson.hpp"

namespace swallowtail::cli {
namespace {

using testing::HasSubstr;

/// Every element is closed by its own name, in order; text holds no bare & or <.
bool is_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < xml.size(); ++i) {
    if (xml[i] == '&') {
      const std::size_t end = xml.find(';', i);
      if (end == std::string::npos || end > i + 6) return false;
    }
    if (xml[i] != '<') continue;
    const std::size_t end = xml.find('>', i);
    if (end == std::string::npos) return false;
    const std::string tag = xml.substr(i + 1, end - i - 1);
    i = end;
    if (tag.empty() || tag.find('<') != std::string::npos) return false;
    if (tag.front() == '?' || tag.back() == '/') continue;
    const std::string name = tag.substr(0, tag.find(' '));
    if (name.front() != '/') {
      open.push_back(name);
    } else if (open.empty() || "/" + open.back() != name) {
      return false;
    } else {
      open.pop_back();
    }
  }
  return open.empty();
}

/// A field with a pond, on Earth, with a battery that needs charging.
coverage::Task task() {
  coverage::Task out;
  out.origin = planner::GeoOrigin{52.0, 5.0, 10.0};
  out.fields = {{1,
                 "meadow & <pond>",
                 {{{0, 0}, {160, 0}, {160, 120}, {0, 120}}, {{{60, 40}, {60, 80}, {100, 80}, {100, 40}}}},
                 20.0}};
  out.no_fly = {{{{120, 90}, {140, 90}, {140, 110}, {120, 110}}, {}}};
  out.battery.capacity = 150.0;
  return out;
}

struct Planned {
  coverage::Task task;
  CoverJob job;
  std::vector<Covered> done;
};

const Planned& planned() {
  static const Planned kPlanned = [] {
    Planned out{task(), {}, {}};
    out.job.name = "job";
    return out;
  }();
  static const std::vector<Covered> kDone = [] {
    auto plan = coverage::plan_coverage(kPlanned.task, planner::Terrain::flat(0.0), {});
    EXPECT_TRUE(plan.ok()) << plan.error().message;
    return std::vector<Covered>{{&kPlanned.task, std::move(*plan), "", 0.0}};
  }();
  static const Planned kAll = {kPlanned.task, kPlanned.job, kDone};
  return kAll;
}

TEST(CoverFiles, KmlIsWellFormedAndHoldsEveryLeg) {
  const std::string kml = cover_kml(planned().done);
  EXPECT_TRUE(is_well_formed(kml));
  EXPECT_THAT(kml, HasSubstr("meadow &amp; &lt;pond&gt;"));
  for (std::size_t i = 0; i < planned().done[0].plan->legs.size(); ++i)
    EXPECT_THAT(kml, HasSubstr("<name>leg " + std::to_string(i) + "</name>"));
  EXPECT_THAT(kml, HasSubstr("<innerBoundaryIs>"));
}

TEST(CoverFiles, ThePictureIsWellFormed) {
  const std::string svg = cover_svg(planned().job, planned().done);
  EXPECT_TRUE(is_well_formed(svg));
  EXPECT_THAT(svg, HasSubstr("class=\"battery\""));
  EXPECT_THAT(svg, HasSubstr("class=\"nofly\""));
  std::vector<Covered> refused = planned().done;
  refused[0].plan.reset();
  refused[0].reason = "Too <small>.";
  EXPECT_TRUE(is_well_formed(cover_svg(planned().job, refused)));
}

/// Keys and kinds as QGroundControl's developer guide documents its plan file format.
TEST(CoverFiles, ThePlanFileHasTheDocumentedStructure) {
  const auto text = cover_qgc_plan(planned().done);
  ASSERT_TRUE(text.ok()) << text.error().message;
  const auto plan = nlohmann::json::parse(*text);
  EXPECT_EQ(plan["fileType"], "Plan");
  EXPECT_EQ(plan["version"], 1);
  EXPECT_TRUE(plan["groundStation"].is_string());
  EXPECT_EQ(plan["geoFence"]["version"], 2);
  ASSERT_EQ(plan["geoFence"]["polygons"].size(), 2U) << "pond and no-fly area";
  for (const auto& fence : plan["geoFence"]["polygons"]) {
    EXPECT_EQ(fence["inclusion"], false);
    EXPECT_GE(fence["polygon"].size(), 3U);
  }
  EXPECT_EQ(plan["rallyPoints"]["version"], 2);
  const auto& mission = plan["mission"];
  EXPECT_EQ(mission["version"], 2);
  EXPECT_EQ(mission["vehicleType"], 2);
  EXPECT_EQ(mission["plannedHomePosition"].size(), 3U);
  const auto& items = mission["items"];
  int take_offs = 0;
  int landings = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    EXPECT_EQ(items[i]["type"], "SimpleItem");
    EXPECT_EQ(items[i]["doJumpId"], static_cast<int>(i) + 1);
    EXPECT_EQ(items[i]["params"].size(), 7U);
    take_offs += items[i]["command"] == 22 ? 1 : 0;
    landings += items[i]["command"] == 21 ? 1 : 0;
    if (items[i]["command"] != 16) continue;
    EXPECT_EQ(items[i]["frame"], 3);
    EXPECT_NEAR(items[i]["params"][4].get<double>(), 52.0, 0.01);
    EXPECT_NEAR(items[i]["params"][5].get<double>(), 5.0, 0.01);
    EXPECT_NEAR(items[i]["params"][6].get<double>(), 20.0, 5.0);
  }
  EXPECT_EQ(items[0]["command"], 22);
  EXPECT_EQ(items.back()["command"], 21);
  const int sorties = static_cast<int>(planned().done[0].plan->rendezvous.size()) + 1;
  EXPECT_GT(sorties, 1);
  EXPECT_EQ(take_offs, sorties);
  EXPECT_EQ(landings, sorties);
}

TEST(CoverFiles, APlanFileIsRefusedForSeveralTasksAndLocalMetres) {
  std::vector<Covered> two = planned().done;
  two.push_back(two.front());
  EXPECT_THAT(cover_qgc_plan(two).error().message, HasSubstr("one mission"));
  coverage::Task local = task();
  local.origin.reset();
  std::vector<Covered> one = planned().done;
  one.front().task = &local;
  EXPECT_THAT(cover_qgc_plan(one).error().message, HasSubstr("local metres"));
}

TEST(CoverFiles, LinesOverThe180thMeridianDoNotGoRoundTheEarth) {
  GeoJsonWriter writer(planner::GeoOrigin{-16.8, 180.0, 0.0});
  writer.add_line({Vec3(-50, 0, 0), Vec3(50, 0, 0), Vec3(-50, 10, 0)}, {});
  const auto line = nlohmann::json::parse(writer.text())["features"][0]["geometry"]["coordinates"];
  ASSERT_EQ(line.size(), 3U);
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    EXPECT_NEAR(std::abs(line[i][0].get<double>() - line[i + 1][0].get<double>()), 0.00094, 1e-5);
}

}  // namespace
}  // namespace swallowtail::cli
