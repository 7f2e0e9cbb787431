// What the commands print, held against expected.json: exit code, one JSON document on standard output,
// values that must be equal, values within limits (`why` says where these are from).
#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/golden/run.hpp"

namespace swallowtail {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run;

const std::string kSource = SWALLOWTAIL_SOURCE_DIR;
const std::string kMissions = kSource + "/tests/data/missions";
const std::string kGolden = kSource + "/tests/golden";

std::string filled(std::string text) {
  for (const auto& [name, value] :
       {std::pair<std::string, std::string>{"{missions}", kMissions}, {"{golden}", kGolden}}) {
    if (const auto at = text.find(name); at != std::string::npos) text.replace(at, name.size(), value);
  }
  return text;
}

std::vector<json> expectations() {
  std::ifstream stream(kGolden + "/expected.json");
  return json::parse(stream).get<std::vector<json>>();
}

class Golden : public ::testing::TestWithParam<json> {};

TEST_P(Golden, PrintsWhatIsExpected) {
  const json& expected = GetParam();
  std::vector<std::string> arguments;
  for (const json& argument : expected["args"]) arguments.push_back(filled(argument.get<std::string>()));
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, expected["exit"].get<int>()) << outcome.err;
  const json actual = json::parse(outcome.out, nullptr, false);
  ASSERT_FALSE(actual.is_discarded()) << outcome.out;
  for (const auto& [place, value] : expected["equal"].items()) {
    ASSERT_TRUE(actual.contains(json::json_pointer(place))) << place;
    EXPECT_EQ(actual.at(json::json_pointer(place)), value) << place;
  }
  for (const auto& [place, limits] : expected["within"].items()) {
    ASSERT_TRUE(actual.contains(json::json_pointer(place))) << place;
    const double value = actual.at(json::json_pointer(place)).get<double>();
    EXPECT_GE(value, limits[0].get<double>() - 1e-6) << place;
    EXPECT_LE(value, limits[1].get<double>() + 1e-6) << place;
  }
  for (const json& key : expected["keys"]) EXPECT_TRUE(actual.contains(key.get<std::string>())) << key;
}

INSTANTIATE_TEST_SUITE_P(Commands, Golden, ::testing::ValuesIn(expectations()),
                         [](const ::testing::TestParamInfo<json>& test_case) {
                           return test_case.param["name"].get<std::string>();
                         });

TEST(CommandLine, ThePlanItWritesIsTheOneItCertifies) {
  const test::ScratchFolder folder;
  const std::string scene = kMissions + "/ten_spheres.yaml";
  ASSERT_EQ(run({"plan", scene, "-q", "-o", folder.file("plan.json")}).exit_code, 0);
  const Outcome good = run({"check", scene, "--plan", folder.file("plan.json"), "--json"});
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_EQ(json::parse(good.out)["verdict"], "certified");
  // The same plan in another scene hits spheres and misses nothing else.
  const Outcome bad =
      run({"check", kMissions + "/five_spheres.yaml", "--plan", folder.file("plan.json"), "--json"});
  const json verdict = json::parse(bad.out);
  EXPECT_EQ(bad.exit_code, verdict["verdict"] == "certified" ? 0 : 1);
  for (const char* key : {"verdict", "violations", "clearance_min_m", "energy_min", "covered_percent"})
    EXPECT_TRUE(verdict.contains(key)) << key;
}

TEST(CommandLine, APlanThroughAnObstacleIsRefusedByPlaceAndObstacle) {
  const test::ScratchFolder folder;
  std::ofstream(folder.file("straight.json"))
      << R"({"waypoints": [{"time_s": 0, "position_m": [1, 1, 1]}, {"time_s": 20, "position_m": [10, 10, 10]}]})";
  const Outcome outcome =
      run({"check", kMissions + "/five_spheres.yaml", "--plan", folder.file("straight.json"), "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const json verdict = json::parse(outcome.out);
  EXPECT_EQ(verdict["verdict"], "violations");
  ASSERT_FALSE(verdict["violations"].empty());
  const json& first = verdict["violations"][0];
  EXPECT_EQ(first["kind"], "obstacle");
  EXPECT_GT(first["by"].get<int>(), 0);
  EXPECT_EQ(first["where_m"].size(), 3u);
  EXPECT_TRUE(first.contains("time_s") && first.contains("detail"));
}

TEST(CommandLine, APlanThatEndsElsewhereIsRefused) {
  const test::ScratchFolder folder;
  std::ofstream(folder.file("short.json"))
      << R"({"waypoints": [{"time_s": 0, "position_m": [1, 1, 1]}, {"time_s": 20, "position_m": [1.5, 1.2, 1]}]})";
  EXPECT_EQ(
      run({"check", kMissions + "/five_spheres.yaml", "--plan", folder.file("short.json"), "-q"}).exit_code,
      1);
}

TEST(CommandLine, BadUsageIsExitCode2AndSaysWhy) {
  const std::vector<std::vector<std::string>> usages = {
      {},
      {"fly"},
      {"plan"},
      {"plan", "nowhere.yaml"},
      {"plan", kMissions + "/two_heights.yaml"},
      {"plan", kMissions + "/ten_spheres.yaml", "--algorithm", "ants"},
      {"plan", kMissions + "/ten_spheres.yaml", "--budget-ms", "-1"},
      {"plan", kMissions + "/ten_spheres.yaml", "-o", "plan.doc"},
      {"plan", kSource + "/tests/data/scenarios/invalid/ten_errors.yaml"},
      {"cover", kMissions + "/two_heights.geojson"},
      {"cover", kMissions + "/ten_spheres.yaml"},
      {"cover", "nowhere.geojson", "--sensor-width", "10"},
      {"cover", kMissions + "/two_heights.geojson", "--sensor-width", "10", "--class-height", "crop"},
      {"gtsp", kMissions + "/two_heights.yaml"},
      {"gtsp", kGolden + "/ring12.gtsp", "--mode", "hasty"},
      {"check", kMissions + "/ten_spheres.yaml"},
      {"check", kMissions + "/ten_spheres.yaml", "--plan", kGolden + "/ring12.gtsp"},
      {"terrain"},
      {"terrain", "--cell-m", "-1", "-o", "t.tif"},
  };
  for (const auto& usage : usages) {
    const Outcome outcome = run(usage);
    std::string line;
    for (const auto& word : usage) line += word + " ";
    EXPECT_EQ(outcome.exit_code, 2) << line;
    EXPECT_TRUE(outcome.out.empty()) << line << outcome.out;
    EXPECT_FALSE(outcome.err.empty()) << line;
  }
}

TEST(CommandLine, AllErrorsOfAScenarioAreTold) {
  const Outcome outcome = run({"plan", kSource + "/tests/data/scenarios/invalid/ten_errors.yaml", "--json"});
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 10) << outcome.err;
}

TEST(CommandLine, HelpOfEachCommandHasExamplesAndExitCodes) {
  for (const char* command : {"plan", "cover", "gtsp", "check", "terrain", "schema"}) {
    const Outcome outcome = run({command, "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.out.find("Examples:"), std::string::npos) << command;
    EXPECT_NE(outcome.out.find("Exit codes:"), std::string::npos) << command;
    for (const char* option : {"--seed", "--json", "--output", "--threads", "--quiet"})
      EXPECT_NE(outcome.out.find(option), std::string::npos) << command << option;
  }
}

TEST(CommandLine, QuietPrintsNothing) {
  const Outcome outcome = run({"plan", kMissions + "/five_spheres.yaml", "-q"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST(CommandLine, SameSeedSamePlan) {
  const auto waypoints = [](const char* threads) {
    const json plan = json::parse(run({"plan", kMissions + "/ten_spheres.yaml", "--json", "--seed", "5",
                                       "--runs", "2", "--threads", threads})
                                      .out);
    return plan["waypoints"].dump() + plan["runs"][1]["waypoints"].dump();
  };
  EXPECT_EQ(waypoints("1"), waypoints("2"));
}

TEST(CommandLine, TerrainIsWrittenAndReadBack) {
  const test::ScratchFolder folder;
  const Outcome outcome = run({"terrain", "--kind", "farmland", "--size-m", "200", "200", "--cell-m", "10",
                               "--relief-m", "9", "--json", "-o", folder.file("hills.tif")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["rows"], 21);
  std::ofstream(folder.file("over.yaml"))
      << "swallowtail: 1\nname: over it\nbounds_m: {min: [0, 0, -1], max: [200, 200, 80]}\nterrain: {kind: "
         "raster, file: hills.tif}\n"
         "vehicle: {radius_m: 0.5, margin_m: 2, cruise_speed_mps: 8}\nstart_m: [10, 10, 40]\ngoal_m: [190, "
         "190, 40]\n";
  const Outcome plan = run({"plan", folder.file("over.yaml"), "--json"});
  EXPECT_EQ(plan.exit_code, 0) << plan.err;
}

TEST(CommandLine, CoverFilesHoldEveryLegTransferAndTheFlightThere) {
  const test::ScratchFolder folder;
  std::ofstream(folder.file("field.geojson"))
      << R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"id":"u"},"geometry":)"
         R"({"type":"Polygon","coordinates":[[[5.0,52.0],[5.003,52.0],[5.003,52.0015],[5.0,52.0015],)"
         R"([5.0,52.0]],[[5.0005,52.0003],[5.0005,52.0012],[5.0009,52.0012],[5.0009,52.0003],)"
         R"([5.0005,52.0003]]]}}]})";
  const std::string field = folder.file("field.geojson");
  const auto cover = [&](const char* file) {
    const Outcome outcome = run({"cover", field, "--sensor-width", "14", "--json", "-o", folder.file(file)});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::ifstream stream(folder.file(file));
    return std::pair(json::parse(outcome.out), std::string(std::istreambuf_iterator<char>(stream), {}));
  };
  const auto [answer, geojson] = cover("legs.geojson");
  const std::size_t legs = answer["legs"].size();
  ASSERT_GT(legs, 4u);
  // Legs, transfers between them, the flight to the first, and rendezvous.
  EXPECT_EQ(json::parse(geojson)["features"].size(), 2 * legs + answer["rendezvous"].size());
  EXPECT_EQ(answer["origins"].size(), 1u);
  EXPECT_GE(answer["approaches_m"][0].size(), 2u);
  const std::string kml = cover("legs.kml").second;
  EXPECT_NE(kml.find("<name>approach</name>"), std::string::npos);
  EXPECT_NE(kml.find("<name>transfer " + std::to_string(legs - 2) + "</name>"), std::string::npos);
}

/// A rectangle near the equator, degrees a metre or so long.
std::string plain_field(const test::ScratchFolder& folder, int wide_m, int high_m) {
  const std::string w = std::to_string(wide_m * 9e-6);
  const std::string h = std::to_string(high_m * 9e-6);
  std::ofstream(folder.file("f.wkt"))
      << "POLYGON((0 0," << w << " 0," << w << " " << h << ",0 " << h << ",0 0))";
  return folder.file("f.wkt");
}

bool is_there(const std::string& file) { return std::ifstream(file).good(); }

TEST(CommandLine, EachOfSeveralAircraftHasItsPartAndItsMissionFile) {
  const test::ScratchFolder folder;
  std::ofstream(folder.file("field.geojson"))
      << R"({"type":"Feature","properties":{"id":"big"},"geometry":{"type":"Polygon","coordinates":)"
         R"([[[5.0,52.0],[5.004,52.0],[5.004,52.0018],[5.0,52.0018],[5.0,52.0]]]}})";
  const std::string plan = folder.file("m.plan");
  const Outcome outcome = run({"cover", folder.file("field.geojson"), "--sensor-width", "12", "--aircraft",
                               "2", "--start", "0,0", "--start", "60,-20", "--json", "-o", plan});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json answer = json::parse(outcome.out);
  ASSERT_EQ(answer["aircraft"].size(), 2u);
  EXPECT_LT(answer["makespan_s"].get<double>(), 0.8 * answer["alone_s"].get<double>());
  std::size_t first = 0;
  for (const json& leg : answer["legs"]) first += leg["aircraft"] == 1 ? 1 : 0;
  EXPECT_EQ(first, answer["aircraft"][0]["sub_cells"].get<std::size_t>());
  EXPECT_EQ(answer["legs"].size() - first, answer["aircraft"][1]["sub_cells"].get<std::size_t>());
  EXPECT_FALSE(is_there(plan));
  for (const char* part : {"m-1.plan", "m-2.plan"}) {
    std::ifstream stream(folder.file(part));
    EXPECT_EQ(json::parse(stream, nullptr, false)["fileType"], "Plan") << part;
  }
}

TEST(CommandLine, ATinyFieldTakesNoLongerWithSeveralAircraft) {
  const test::ScratchFolder folder;
  const std::string field = plain_field(folder, 60, 18);
  const auto makespan_s = [&](const char* aircraft, std::string& notes) {
    const Outcome outcome = run({"cover", field, "--sensor-width", "10", "--aircraft", aircraft, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json answer = json::parse(outcome.out);
    notes = answer["notes"].dump();
    return answer["makespan_s"].get<double>();
  };
  std::string alone_notes;
  std::string notes;
  const double alone_s = makespan_s("1", alone_notes);
  EXPECT_LE(makespan_s("5", notes), alone_s + 1e-6);
  EXPECT_NE(notes.find("Of 5 aircraft "), std::string::npos) << notes;
  EXPECT_EQ(alone_notes.find("aircraft"), std::string::npos) << alone_notes;
}

TEST(CommandLine, StartsThatDoNotFitAreRefused) {
  const test::ScratchFolder folder;
  const std::string field = plain_field(folder, 200, 100);
  const auto refusal = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"cover", field, "--sensor-width", "10"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_NE(outcome.exit_code, 0);
    return outcome.err + outcome.out;
  };
  EXPECT_NE(refusal({"--start", "5;5"}).find("EAST,NORTH"), std::string::npos);
  EXPECT_NE(refusal({"--start", "nan,5"}).find("EAST,NORTH"), std::string::npos);
  EXPECT_NE(refusal({"--aircraft", "3", "--start", "0,0"}).find("1 for 3 aircraft"), std::string::npos);
  const std::string near = refusal({"--start", "0,0", "--start", "1,0"});
  EXPECT_NE(near.find("nearer to each other"), std::string::npos) << near;
}

TEST(CommandLine, AFieldIsDrawnAsAPngWhereTheProgramForItIs) {
  const test::ScratchFolder folder;
  const std::string field = plain_field(folder, 100, 50);
  const std::string picture = folder.file("plan.png");
  const Outcome outcome = run({"cover", field, "--sensor-width", "10", "-o", picture});
  if (outcome.exit_code == 2) {
    EXPECT_NE(outcome.err.find("librsvg2-bin"), std::string::npos) << outcome.err;
    EXPECT_FALSE(is_there(picture));
    return;
  }
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::ifstream stream(picture, std::ios::binary);
  std::string head(8, ' ');
  stream.read(head.data(), 8);
  EXPECT_EQ(head, "\x89PNG\r\n\x1a\n");
}

TEST(CommandLine, ARobotWithABatteryOfItsOwnFetchesNewEnergyOrItIsTold) {
  const test::ScratchFolder folder;
  const std::string field = plain_field(folder, 200, 150);
  const auto plan = [&](const char* robot_capacity) {
    return run({"cover", field, "--sensor-width", "8", "--capacity", "90", "--robot-capacity", robot_capacity,
                "--robot-drive-per-s", "0.2", "--robot-refill", "30", "--json"});
  };
  const Outcome outcome = plan("250");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json answer = json::parse(outcome.out);
  std::size_t fetches = 0;
  for (const json& meeting : answer["rendezvous"]) fetches += meeting.contains("from_depot_s") ? 1 : 0;
  EXPECT_GE(fetches, 1u);
  EXPECT_LT(fetches, answer["rendezvous"].size());
  const Outcome refused = plan("40");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(json::parse(refused.out)["reason"].get<std::string>().find("ground robot's battery holds 40"),
            std::string::npos);
}

}  // namespace
}  // namespace swallowtail
