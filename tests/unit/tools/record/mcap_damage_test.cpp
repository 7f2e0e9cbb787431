#include <random>

#include "tests/unit/tools/record/mcap_fixture.hpp"

namespace swallowtail::mcap {
namespace {

bool is_prefix(const std::vector<Sample>& part, const std::vector<Sample>& whole) {
  return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
}

/// Each message read was written, in the same order; some may be missing.
bool is_part(const std::vector<Sample>& part, const std::vector<Sample>& whole) {
  auto at = whole.begin();
  for (const Sample& sample : part) {
    at = std::find(at, whole.end(), sample);
    if (at == whole.end()) return false;
    ++at;
  }
  return true;
}

class Damage : public McapTest, public ::testing::WithParamInterface<Compression> {};
INSTANTIATE_TEST_SUITE_P(Compressions, Damage, ::testing::Values(Compression::kNone, Compression::kZstd),
                         [](const auto& c) { return "c" + std::string(compression_name(c.param)); });

TEST_P(Damage, AFileCutAtAnyByteGivesAGrowingPrefix) {
  const auto written = write_small_file(file("whole.mcap"), 40, {.compression = GetParam()});
  const std::string whole = bytes_of(file("whole.mcap"));
  std::size_t most = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    put_bytes(file("cut.mcap"), std::string_view(whole).substr(0, size));
    const auto reader = Reader::open(file("cut.mcap"));
    ASSERT_EQ(reader.ok(), size >= kMagic.size()) << size;
    if (!reader.ok()) continue;
    EXPECT_EQ(reader->condition(), Reader::Condition::kRecovered) << size;
    EXPECT_FALSE(reader->problems().empty()) << size;
    const auto read = samples_of(*reader);
    EXPECT_TRUE(is_prefix(read, written)) << "cut at byte " << size;
    EXPECT_GE(read.size(), most) << "cut at byte " << size << ": a longer file gives less";
    most = std::max(most, read.size());
  }
  EXPECT_EQ(most, written.size()) << "all chunks stand before the summary";
}

TEST_P(Damage, OneWrongByteAnywhereNeverGivesAMessageThatWasNotWritten) {
  const auto written = write_small_file(file("whole.mcap"), 40, {.compression = GetParam()});
  const std::string whole = bytes_of(file("whole.mcap"));
  std::size_t found = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    put_bytes(file("damaged.mcap"), damaged);
    const auto reader = Reader::open(file("damaged.mcap"));
    if (!reader.ok()) {
      EXPECT_LT(at, kMagic.size());
      continue;
    }
    std::vector<Sample> read;
    const auto done = reader->for_each_message(
        [&](const Channel& c, const Message& m) {
          read.push_back({c.topic, m.sequence, m.log_time_ns, m.publish_time_ns,
                          std::string(reinterpret_cast<const char*>(m.data.data()), m.data.size())});
        },
        OnDamage::kSkip);
    ASSERT_TRUE(done.ok());
    EXPECT_TRUE(is_part(read, written)) << "byte " << at;
    const bool noticed = *done > 0 || !reader->problems().empty();
    EXPECT_TRUE(noticed || read == written) << "byte " << at << ": messages are missing and nothing says so";
    found += noticed ? 1 : 0;
  }
  EXPECT_GT(found, whole.size() / 4);
}

TEST_F(McapTest, ADamagedChunkFailsTheReadingOrIsLeftOut) {
  const auto written = write_small_file(file("a.mcap"), 40, {.compression = Compression::kNone});
  std::string bytes = bytes_of(file("a.mcap"));
  const std::size_t at = bytes.find("payload 17");
  ASSERT_NE(at, std::string::npos);
  bytes[at] = 'P';
  put_bytes(file("a.mcap"), bytes);
  const auto reader = Reader::open(file("a.mcap"));
  ASSERT_TRUE(reader.ok());
  const auto strict = reader->for_each_message([](const Channel&, const Message&) {});
  ASSERT_FALSE(strict.ok());
  EXPECT_NE(strict.error().message.find("CRC"), std::string::npos) << strict.error().message;
  const auto rest = samples_of(*reader, OnDamage::kSkip);
  EXPECT_LT(rest.size(), written.size());
  EXPECT_GT(rest.size(), written.size() / 2);
}

TEST_F(McapTest, AnUnfinishedFileLosesItsOpenChunkOnly) {
  {
    auto writer = Writer::create(file("a.mcap"), {.chunk_span_ns = 100});
    ASSERT_TRUE(writer.ok());
    const auto channel = writer->add_channel(0, "t", "json");
    for (std::uint32_t i = 0; i <= 250; ++i) ASSERT_TRUE(put(*writer, *channel, {"t", i, i, i, "x"}).ok());
    std::filesystem::copy_file(file("a.mcap"), file("killed.mcap"));
  }
  const auto reader = Reader::open(file("killed.mcap"));
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(samples_of(*reader).size(), 202u) << "two chunks of 101 messages";
}

TEST_F(McapTest, WhatIsNoMcapFileIsRefused) {
  put_bytes(file("empty"), "");
  put_bytes(file("text"), "this is no recording, whatever its name says");
  EXPECT_FALSE(Reader::open(file("empty")).ok());
  EXPECT_FALSE(Reader::open(file("text")).ok());
  EXPECT_FALSE(Reader::open(file("is not there")).ok());
  EXPECT_FALSE(Reader::open(std::filesystem::temp_directory_path()).ok());
}

TEST_F(McapTest, RandomBytesAfterTheMagicNeverCrash) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::string bytes(reinterpret_cast<const char*>(kMagic.data()), kMagic.size());
    const std::size_t size = random() % 400;
    // Small values make plausible opcodes and lengths.
    for (std::size_t i = 0; i < size; ++i)
      bytes.push_back(static_cast<char>(random() % 3 == 0 ? random() % 16 : 0));
    put_bytes(file("a.mcap"), bytes);
    const auto reader = Reader::open(file("a.mcap"));
    ASSERT_TRUE(reader.ok());
    EXPECT_TRUE(reader->for_each_message([](const Channel&, const Message&) {}, OnDamage::kSkip).ok());
  }
}

TEST_F(McapTest, RandomDamageOfManyBytesNeverCrashes) {
  write_small_file(file("whole.mcap"), 200);
  const std::string whole = bytes_of(file("whole.mcap"));
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::string damaged = whole;
    for (auto n = random() % 20; n > 0; --n)
      damaged[8 + random() % (damaged.size() - 8)] = static_cast<char>(random());
    put_bytes(file("a.mcap"), damaged);
    const auto reader = Reader::open(file("a.mcap"));
    ASSERT_TRUE(reader.ok());
    EXPECT_TRUE(reader->for_each_message([](const Channel&, const Message&) {}, OnDamage::kSkip).ok());
  }
}

TEST_F(McapTest, AChunkThatClaimsTooMuchIsNotUnpacked) {
  const auto written = write_small_file(file("a.mcap"), 40);
  const auto reader = Reader::open(file("a.mcap"), {.max_chunk_bytes = 100});
  ASSERT_TRUE(reader.ok());
  const auto done = reader->for_each_message([](const Channel&, const Message&) {});
  ASSERT_FALSE(done.ok());
  EXPECT_NE(done.error().message.find("100"), std::string::npos) << done.error().message;
}

}  // namespace
}  // namespace swallowtail::mcap
