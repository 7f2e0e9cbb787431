// Valid GTSPLIB and tour files with random damage: the readers must end, give something sound or an error
// with file and line, and never crash. Run it under the sanitizers.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "coverage/gtsp/gtsplib.hpp"
#include "coverage/gtsp/tour_file.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::gtsp {
namespace {

const std::vector<std::string> kValid = {
    "NAME : p\nTYPE : GTSP\nCOMMENT : a : b\nDIMENSION : 5\nGTSP_SETS : 2\nEDGE_WEIGHT_TYPE : EUC_2D\n"
    "NODE_COORD_SECTION\n1 0 0\n2 3.5e+00 4\n3 6 8\n4 -1 1\n5 7 7\nGTSP_SET_SECTION\n1 1 4 -1\n2 2 3 5 "
    "-1\nEOF\n",
    "NAME: g\nTYPE: GTSP\nDIMENSION: 3\nGTSP_SETS: 3\nEDGE_WEIGHT_TYPE: GEO\nNODE_COORD_SECTION\n1 36.49 "
    "7.49\n"
    "2 57.06 9.51\n3 30.22 48.14\nGTSP_SET_SECTION\n1 1 -1\n2 2 -1\n3 3 -1\nEOF\n",
    "NAME : a\nTYPE  AGTSP\nDIMENSION : 4\nGTSP_SETS : 2\nEDGE_WEIGHT_TYPE : EXPLICIT\nEDGE_WEIGHT_FORMAT : "
    "FULL_MATRIX\nEDGE_WEIGHT_SECTION\n0 1 2 3\n4 0 5 6\n7 8 0 9\n1 2 3 0\nGTSP_SET_SECTION\n1 1 2 -1\n2 3 4 "
    "-1\nEOF\n",
    "NAME : u\nTYPE : GTSP\nDIMENSION : 4\nGTSP_SETS : 4\nEDGE_WEIGHT_TYPE : EXPLICIT\nEDGE_WEIGHT_FORMAT : "
    "UPPER_DIAG_ROW\nEDGE_WEIGHT_SECTION\n0 1 2 3\n0 5 6\n0 9\n0\nGTSP_SET_SECTION\n1 1 -1\n2 2 -1\n3 3 "
    "-1\n4 4 "
    "-1\nEOF\n"};

const std::string kTour = "NAME : t\nTYPE : TOUR\nDIMENSION : 3\nTOUR_SECTION\n1\n3\n2\n-1\nEOF\n";

const std::vector<std::string> kFragments = {"-1",
                                             " ",
                                             "\n",
                                             ":",
                                             "nan",
                                             "inf",
                                             "1e999",
                                             "-1e999",
                                             "99999999999999999999",
                                             "200001",
                                             "\xff",
                                             "\t",
                                             "0",
                                             "-0",
                                             "1.5",
                                             "0x1",
                                             "EOF\n",
                                             "GTSP_SET_SECTION\n",
                                             "\r\n",
                                             "+",
                                             "1e308",
                                             "1e-320",
                                             "-2",
                                             "e",
                                             std::string(1, '\0'),
                                             "NODE_COORD_SECTION\n",
                                             "DIMENSION : 2\n",
                                             "DIMENSION : 200000\n",
                                             "GTSP_SETS : 1\n",
                                             "TYPE : TSP\n",
                                             "EDGE_WEIGHT_SECTION\n",
                                             "EDGE_WEIGHT_TYPE : ATT\n",
                                             "EDGE_WEIGHT_FORMAT : LOWER_ROW\n"};

std::string damaged(std::string text, Rng& rng) {
  const std::uint64_t count = 1 + rng.below(3);
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto place = text.empty() ? std::size_t{0} : static_cast<std::size_t>(rng.below(text.size()));
    const auto length = static_cast<std::size_t>(rng.below(20));
    switch (rng.below(6)) {
      case 0:
        text.erase(place, length);
        break;
      case 1:
        text.insert(place, kFragments[rng.below(kFragments.size())]);
        break;
      case 2:
        if (!text.empty()) text[place] = static_cast<char>(rng.below(256));
        break;
      case 3:
        text.insert(place, text.substr(place, length * 3));
        break;
      case 4:
        text.resize(place);
        break;
      default: {
        const std::string& other = kValid[rng.below(kValid.size())];
        text.replace(place, length, other.substr(static_cast<std::size_t>(rng.below(other.size())), length));
      }
    }
  }
  return text;
}

int runs() {
  const char* wanted = std::getenv("SWALLOWTAIL_FUZZ_RUNS");
  return wanted != nullptr ? std::atoi(wanted) : 30'000;
}

void expect_sound(const Instance& instance) {
  std::vector<int> owners(static_cast<std::size_t>(instance.vertex_count()), 0);
  for (int c = 0; c < instance.cluster_count(); ++c) {
    ASSERT_FALSE(instance.cluster(c).empty());
    for (const int v : instance.cluster(c)) {
      ASSERT_EQ(instance.cluster_of(v), c);
      ++owners[static_cast<std::size_t>(v)];
    }
  }
  ASSERT_TRUE(std::ranges::all_of(owners, [](int n) { return n == 1; }));
  for (int u = 0; u < std::min(instance.vertex_count(), 6); ++u) {
    for (int v = 0; v < std::min(instance.vertex_count(), 6); ++v) {
      const double cost = instance.cost(u, v);
      ASSERT_TRUE(u == v ? std::isinf(cost) : cost >= 0.0 && cost <= kMaxArcCost)
          << u << ' ' << v << ' ' << cost;
    }
  }
}

/// `fuzz:LINE: …`, LINE within the text.
void expect_located(const std::string& message, const std::string& text) {
  ASSERT_EQ(message.rfind("fuzz:", 0), 0U) << message;
  const int line = std::atoi(message.c_str() + 5);
  ASSERT_GE(line, 1) << message;
  ASSERT_LE(line, 1 + std::count(text.begin(), text.end(), '\n')) << message;
}

TEST(GtsplibFuzz, DamagedFilesGiveASoundInstanceOrAnErrorWithItsLine) {
  int accepted = 0;
  for (int run = 0; run < runs(); ++run) {
    Rng rng(static_cast<std::uint64_t>(run));
    SCOPED_TRACE("seed " + std::to_string(run));
    const std::string text = damaged(kValid[rng.below(kValid.size())], rng);
    std::istringstream in(text);
    const Result<Instance> instance = read_gtsplib(in, "fuzz");
    if (instance.ok()) {
      ++accepted;
      expect_sound(*instance);
    } else {
      expect_located(instance.error().message, text);
    }
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(accepted, runs() / 200) << "the damage leaves nothing to accept";
  EXPECT_LT(accepted, runs()) << "the damage does none";
}

TEST(GtsplibFuzz, DamagedToursGiveVerticesOrAnErrorWithItsLine) {
  for (int run = 0; run < runs() / 3; ++run) {
    Rng rng(static_cast<std::uint64_t>(run) + 1'000'000);
    SCOPED_TRACE("seed " + std::to_string(run));
    const std::string text = damaged(kTour, rng);
    std::istringstream in(text);
    const auto tour = read_tour(in, "fuzz");
    if (tour.ok()) {
      for (const int v : *tour) ASSERT_TRUE(v >= 0 && v < kMaxVertices);
    } else {
      expect_located(tour.error().message, text);
    }
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace swallowtail::gtsp
