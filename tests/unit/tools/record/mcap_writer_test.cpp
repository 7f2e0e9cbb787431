#include <algorithm>
#include <random>

#include "tests/unit/tools/record/mcap_fixture.hpp"
#include "tools/record/mcap/checksum.hpp"

namespace swallowtail::mcap {
namespace {

TEST(Crc32, IsTheOneOfTheStandardCheckValue) {
  EXPECT_EQ(crc32(std::as_bytes(std::span(std::string_view("123456789")))), 0xCBF43926u);
  EXPECT_EQ(crc32(std::as_bytes(std::span(std::string_view("6789"))),
                  crc32(std::as_bytes(std::span(std::string_view("12345"))))),
            0xCBF43926u);
}

class RoundTrip : public McapTest, public ::testing::WithParamInterface<Compression> {};

TEST_P(RoundTrip, GivesBackWhatWasWritten) {
  if (!is_supported(GetParam())) GTEST_SKIP() << "this build has no LZ4";
  const auto written =
      write_small_file(file("a.mcap"), 100, {.compression = GetParam(), .data_section_crc = true});
  const auto reader = Reader::open(file("a.mcap"));
  ASSERT_TRUE(reader.ok()) << reader.error().message;
  EXPECT_EQ(reader->condition(), Reader::Condition::kComplete);
  EXPECT_TRUE(reader->problems().empty());
  EXPECT_EQ(samples_of(*reader), written);
  ASSERT_EQ(reader->channels().size(), 2u);
  EXPECT_EQ(reader->channels()[0].metadata.at("keyed"), "true");
  ASSERT_NE(reader->find_schema(reader->channels()[0].schema_id), nullptr);
  EXPECT_EQ(reader->find_schema(reader->channels()[0].schema_id)->name, "t::A");
  EXPECT_EQ(reader->find_schema(0), nullptr);
  ASSERT_EQ(reader->metadata().size(), 1u);
  EXPECT_EQ(reader->metadata()[0].entries.at("A"), "received=1");
  ASSERT_TRUE(reader->statistics().has_value());
  EXPECT_EQ(reader->statistics()->messages, 100u);
  EXPECT_EQ(reader->statistics()->start_ns, 1000u);
  EXPECT_EQ(reader->statistics()->end_ns, 1099u);
  EXPECT_GT(reader->statistics()->chunks, 5u);
}

INSTANTIATE_TEST_SUITE_P(Compressions, RoundTrip,
                         ::testing::Values(Compression::kNone, Compression::kZstd, Compression::kLz4),
                         [](const auto& c) { return "c" + std::string(compression_name(c.param)); });

TEST_F(McapTest, GivesMessagesInLogOrderThoughChunksOverlap) {
  std::vector<Sample> samples;
  for (std::uint32_t i = 0; i < 500; ++i)
    samples.push_back({"t", i, 10'000u + (i * 37u) % 501u, i, "x" + std::to_string(i)});
  auto writer = Writer::create(file("a.mcap"), {.chunk_bytes = 1024});
  ASSERT_TRUE(writer.ok());
  const auto channel = writer->add_channel(0, "t", "json");
  for (const Sample& s : samples) ASSERT_TRUE(put(*writer, *channel, s).ok());
  ASSERT_TRUE(writer->finish().ok());
  std::stable_sort(samples.begin(), samples.end(),
                   [](const auto& a, const auto& b) { return a.log_time_ns < b.log_time_ns; });
  const auto reader = Reader::open(file("a.mcap"));
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(samples_of(*reader), samples);
}

TEST_F(McapTest, AMessageLargerThanAChunkIsKept) {
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the test wants the same bytes each time
  std::string large(5'000'000, '\0');
  for (char& c : large) c = static_cast<char>(random());
  auto writer = Writer::create(file("a.mcap"));
  ASSERT_TRUE(writer.ok());
  const auto channel = writer->add_channel(0, "t", "cdr");
  ASSERT_TRUE(put(*writer, *channel, {"t", 1, 5, 5, large}).ok());
  ASSERT_TRUE(put(*writer, *channel, {"t", 2, 6, 6, ""}).ok());
  ASSERT_TRUE(writer->finish().ok());
  const auto reader = Reader::open(file("a.mcap"));
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(samples_of(*reader), (std::vector<Sample>{{"t", 1, 5, 5, large}, {"t", 2, 6, 6, ""}}));
}

TEST_F(McapTest, AFileWithoutMessagesIsComplete) {
  auto writer = Writer::create(file("a.mcap"));
  ASSERT_TRUE(writer.ok());
  ASSERT_TRUE(writer->finish().ok());
  const auto reader = Reader::open(file("a.mcap"));
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(reader->condition(), Reader::Condition::kComplete);
  EXPECT_TRUE(samples_of(*reader).empty());
}

TEST_F(McapTest, WhatWasFlushedReadsWhileTheFileIsStillOpen) {
  auto writer = Writer::create(file("a.mcap"));
  ASSERT_TRUE(writer.ok());
  const auto channel = writer->add_channel(0, "t", "json");
  ASSERT_TRUE(put(*writer, *channel, {"t", 1, 5, 5, "one"}).ok());
  ASSERT_TRUE(writer->flush().ok());
  ASSERT_TRUE(put(*writer, *channel, {"t", 2, 6, 6, "two"}).ok());
  const auto reader = Reader::open(file("a.mcap"));
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(reader->condition(), Reader::Condition::kRecovered);
  EXPECT_EQ(samples_of(*reader), (std::vector<Sample>{{"t", 1, 5, 5, "one"}}));
}

TEST_F(McapTest, RefusesWhatItCannotWrite) {
  EXPECT_FALSE(Writer::create(file("no/such/folder/a.mcap")).ok());
  EXPECT_FALSE(Writer::create(file("a.mcap"), {.zstd_level = 0}).ok());
  EXPECT_FALSE(Writer::create(file("a.mcap"), {.chunk_bytes = 1}).ok());
  EXPECT_FALSE(Writer::create(file("a.mcap"), {.chunk_span_ns = 0}).ok());
  auto writer = Writer::create(file("a.mcap"));
  ASSERT_TRUE(writer.ok());
  EXPECT_FALSE(writer->add_channel(1, "t", "cdr").ok()) << "schema 1 has not been added";
  EXPECT_FALSE(put(*writer, 0, {"t", 1, 5, 5, "x"}).ok()) << "channel 0 has not been added";
  ASSERT_TRUE(writer->finish().ok());
  EXPECT_TRUE(writer->finish().ok()) << "finishing twice is harmless";
  EXPECT_FALSE(writer->write_metadata({"late", {}}).ok());
}

TEST(McapDisk, AFullDiskIsAnErrorThatNamesTheFile) {
  const auto writer = Writer::create("/dev/full");
  ASSERT_FALSE(writer.ok());
  EXPECT_NE(writer.error().message.find("/dev/full"), std::string::npos);
  EXPECT_NE(writer.error().message.find("No space left"), std::string::npos);
}

}  // namespace
}  // namespace swallowtail::mcap
