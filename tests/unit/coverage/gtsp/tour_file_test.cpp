#include "coverage/gtsp/tour_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace swallowtail::gtsp {
namespace {

TEST(TourFile, ReadsBackWhatItWrites) {
  const std::vector<int> tour = {4, 0, 7};
  std::stringstream file;
  ASSERT_TRUE(write_tour(file, "x", tour, 12.5).ok());
  EXPECT_THAT(file.str(), testing::HasSubstr("TOUR_SECTION\n5\n1\n8\n-1\n"));
  const auto read = read_tour(file, "file");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value(), tour);
}

TEST(TourFile, RefusesWhatIsNoTour) {
  const auto refusal = [](const std::string& text) {
    std::istringstream in(text);
    const auto tour = read_tour(in, "file");
    return tour.ok() ? std::string("accepted") : tour.error().message;
  };
  EXPECT_EQ(refusal("NAME : x\n1 2 3\n"), "file:3: TOUR_SECTION: missing: must be given");
  EXPECT_THAT(refusal("TOUR_SECTION\n1\n0\n-1\n"), testing::HasSubstr("file:3: TOUR_SECTION: 0: must be"));
  EXPECT_THAT(refusal("TOUR_SECTION\n1 two\n"), testing::HasSubstr("two"));
  EXPECT_EQ(refusal("TOUR_SECTION\n1 2\nEOF\n"), "accepted");
}

}  // namespace
}  // namespace swallowtail::gtsp
