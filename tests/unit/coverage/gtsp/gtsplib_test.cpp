#include "coverage/gtsp/gtsplib.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace swallowtail::gtsp {
namespace {

using testing::HasSubstr;

Result<Instance> read(const std::string& text) {
  std::istringstream in(text);
  return read_gtsplib(in, "file");
}

std::string refusal(const std::string& text) {
  const Result<Instance> instance = read(text);
  return instance.ok() ? "accepted" : instance.error().message;
}

std::string explicit_file(const std::string& format, const std::string& weights) {
  return "NAME: x\nTYPE: GTSP\nDIMENSION: 3\nGTSP_SETS: 2\nEDGE_WEIGHT_TYPE: EXPLICIT\nEDGE_WEIGHT_FORMAT: " +
         format + "\nEDGE_WEIGHT_SECTION\n" + weights + "\nGTSP_SET_SECTION\n1 1 -1\n2 2 3 -1\nEOF\n";
}

const std::string kPoints =
    "NAME : x\nTYPE : GTSP\nCOMMENT : any : thing\nDIMENSION : 3\nGTSP_SETS : 2\nEDGE_WEIGHT_TYPE : EUC_2D\n"
    "NODE_COORD_SECTION\n1 0 0\n2 3.0e+00 4\n3 +6 8\nGTSP_SET_SECTION\n1 1 -1\n2 2 3 -1\nEOF\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto found = text.find(from);
  EXPECT_NE(found, std::string::npos) << from;
  return text.replace(found, from.size(), to);
}

TEST(Gtsplib, ReadsPoints) {
  const Result<Instance> instance = read(kPoints);
  ASSERT_TRUE(instance.ok()) << instance.error().message;
  EXPECT_EQ(instance->vertex_count(), 3);
  EXPECT_EQ(instance->cluster_count(), 2);
  EXPECT_EQ(instance->cost(0, 2), 10.0);
  EXPECT_EQ(instance->cluster_of(2), 1);
}

TEST(Gtsplib, ReadsEverySpellingOfHeaders) {
  for (const std::string type : {"TYPE:GTSP", "TYPE  AGTSP", "Type :  gtsp ", "TYPE : GTSP (comment)"}) {
    EXPECT_TRUE(read(replaced(kPoints, "TYPE : GTSP", type)).ok()) << type;
  }
  for (const std::string sets : {"GTSP_SETS:2", "GTSP_SETS 2", "GTSP_SETS :  2\r", "\n\n  GTSP_SETS : 2"}) {
    EXPECT_TRUE(read(replaced(kPoints, "GTSP_SETS : 2", sets)).ok()) << sets;
  }
  EXPECT_TRUE(read(replaced(kPoints, "GTSP_SET_SECTION", "GTSP_SET_SECTION :")).ok());
  EXPECT_TRUE(
      read(replaced(kPoints, "GTSP_SET_SECTION", "DISPLAY_DATA_SECTION\n1 0 0\n2 -1 .5\nGTSP_SET_SECTION"))
          .ok());
  EXPECT_TRUE(read(replaced(kPoints, "-1\nEOF\n", "-1")).ok());
  EXPECT_TRUE(read(replaced(kPoints, "1 1 -1\n2 2 3 -1", "2\n3 2\n-1 1 1\n-1")).ok());
}

TEST(Gtsplib, ReadsEveryPointMetric) {
  for (const std::string metric : {"CEIL_2D", "GEO", "GEOM", "ATT"}) {
    const auto instance = read(replaced(kPoints, "EUC_2D", metric));
    ASSERT_TRUE(instance.ok()) << metric;
    EXPECT_GT(instance->cost(0, 1), 0.0) << metric;
  }
}

TEST(Gtsplib, ReadsEveryMatrixForm) {
  for (const auto& [format, weights] :
       std::vector<std::pair<std::string, std::string>>{{"FULL_MATRIX", "99 1 2 1 99 3 2 3 99"},
                                                        {"UPPER_ROW", "1 2 3"},
                                                        {"LOWER_COL", "1 2 3"},
                                                        {"LOWER_ROW", "1\n2 3"},
                                                        {"UPPER_COL", "1 2 3"},
                                                        {"UPPER_DIAG_ROW", "0 1 2 -5 3 0"},
                                                        {"LOWER_DIAG_COL", "0 1 2 0 3 0"},
                                                        {"LOWER_DIAG_ROW", "0 1 0 2 3 0"},
                                                        {"UPPER_DIAG_COL", "0 1 0 2 3 0"}}) {
    const auto instance = read(explicit_file(format, weights));
    ASSERT_TRUE(instance.ok()) << format << instance.error().message;
    EXPECT_EQ(instance->cost(0, 1), 1.0) << format;
    EXPECT_EQ(instance->cost(2, 0), 2.0) << format;
    EXPECT_EQ(instance->cost(1, 2), 3.0) << format;
  }
  const auto asymmetric = read(explicit_file("FULL_MATRIX", "0 1 2 3 0 4 5 6 0"));
  EXPECT_EQ(asymmetric->cost(1, 0), 3.0);
  EXPECT_EQ(asymmetric->cost(0, 1), 1.0);
}

TEST(Gtsplib, NamesFileLineKeyValueAndRule) {
  EXPECT_EQ(refusal(replaced(kPoints, "GTSP_SETS : 2", "GTSP_SETS : two")),
            "file:5: GTSP_SETS: two: must be an integer from 1 to 200000");
  EXPECT_EQ(refusal(replaced(kPoints, "2 3.0e+00 4", "2 3.0e+00 x")),
            "file:9: NODE_COORD_SECTION: x: must be a number");
  EXPECT_EQ(refusal(replaced(kPoints, "2 2 3 -1", "2 2 4 -1")),
            "file:13: GTSP_SET_SECTION: 4: must be from 1 to 3, or -1 to end the set");
}

TEST(Gtsplib, RefusesWhatIsMalformed) {
  EXPECT_THAT(refusal(""), HasSubstr("DIMENSION: missing"));
  EXPECT_THAT(refusal("hello world"), HasSubstr("HELLO: world: is not a key"));
  EXPECT_THAT(refusal("TYPE : CVRP"), HasSubstr("must be GTSP"));
  EXPECT_THAT(refusal("DIMENSION : 2000000000"), HasSubstr("from 1 to 200000"));
  EXPECT_THAT(refusal("DIMENSION : -1"), HasSubstr("from 1 to"));
  EXPECT_THAT(refusal("GTSP_SETS : 99999999999999999999"), HasSubstr("from 1 to"));
  EXPECT_THAT(refusal("NODE_COORD_SECTION\n1 0 0"), HasSubstr("DIMENSION must come before"));
  EXPECT_THAT(refusal(replaced(kPoints, "EUC_2D", "MOON_3D")), HasSubstr("MOON_3D"));
  EXPECT_THAT(refusal(replaced(kPoints, "3 +6 8", "2 6 8")), HasSubstr("must appear once"));
  EXPECT_EQ(refusal(replaced(kPoints, "3 +6 8", "3 nan 8")),
            "file:10: NODE_COORD_SECTION: 3: coordinates must be finite, within 1e11");
  EXPECT_THAT(refusal(replaced(kPoints, "3 +6 8", "3 1e300 8")), HasSubstr("file:10: "));
  EXPECT_EQ(refusal(replaced(kPoints, "2 2 3 -1", "2 2 1 3 -1")),
            "file:13: GTSP_SET_SECTION: 1: is also in set 1; it must be in exactly one");
  EXPECT_EQ(refusal(replaced(kPoints, "1 1 -1", "1 -1")),
            "file:12: GTSP_SET_SECTION: 1: the set is empty; each must hold a vertex");
  EXPECT_EQ(refusal(kPoints + "4 5\n"), "file:15: EOF: 4 5: nothing may follow it");
  EXPECT_THAT(refusal(replaced(kPoints, "2 2 3 -1", "2 2 -1")), HasSubstr("vertex 3 is in no set"));
  EXPECT_THAT(refusal(replaced(kPoints, "2 2 3 -1", "2 2 3")), HasSubstr("EOF: must be an integer"));
  EXPECT_THAT(refusal(replaced(kPoints, "2 2 3 -1", "1 2 3 -1")), HasSubstr("must appear once"));
  EXPECT_THAT(refusal(replaced(kPoints, "2 2 3 -1\nEOF", "2 2")), HasSubstr("end of file"));
  EXPECT_THAT(refusal(explicit_file("FULL_MATRIX", "0 1 2 3 0")), HasSubstr("must be a number"));
  EXPECT_THAT(refusal(explicit_file("UPPER_ROW", "1 -2 3")), HasSubstr("must be from 0 to"));
  EXPECT_THAT(refusal(explicit_file("SPIRAL", "1 2 3")), HasSubstr("SPIRAL"));
  EXPECT_THAT(refusal("DIMENSION : 100000\nEDGE_WEIGHT_FORMAT : FULL_MATRIX\nEDGE_WEIGHT_SECTION\n1"),
              HasSubstr("at most 6000 rows"));
}

TEST(Gtsplib, SurvivesEveryTruncationAndByteChange) {
  for (const std::string& text : {kPoints, explicit_file("UPPER_ROW", "1 2 3")}) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      (void)read(text.substr(0, i));
      for (const char c : {'\0', '9', '-', ' ', '\n', 'Z', '\xff'}) {
        std::string changed = text;
        changed[i] = c;
        const auto instance = read(changed);
        if (instance.ok()) {
          EXPECT_LE(instance->cluster_count(), instance->vertex_count());
        }
      }
    }
  }
}

TEST(Gtsplib, ReportsAFileThatIsNotThere) {
  const auto instance = read_gtsplib(std::filesystem::path("/nowhere/x.gtsp"));
  ASSERT_FALSE(instance.ok());
  EXPECT_EQ(instance.error().code, Error::Code::kNotFound);
}

}  // namespace
}  // namespace swallowtail::gtsp
