#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tools/record/mcap/reader.hpp"
#include "tools/record/mcap/writer.hpp"

namespace swallowtail::mcap {

/// One message, owning its bytes, to compare what was written with what was read.
struct Sample {
  std::string topic;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::string data;
  bool operator==(const Sample&) const = default;
};

inline void PrintTo(const Sample& s, std::ostream* out) {
  *out << s.topic << " #" << s.sequence << " at " << s.log_time_ns << " \"" << s.data << '"';
}

class McapTest : public ::testing::Test {
 protected:
  McapTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("swallowtail_mcap_" + std::to_string(::getpid()) + "_" + test_name())) {
    std::filesystem::create_directories(folder_);
  }
  ~McapTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  static std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static void put_bytes(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

  /// Reads all messages; the reading itself must not fail.
  static std::vector<Sample> samples_of(const Reader& reader, OnDamage on_damage = OnDamage::kFail) {
    std::vector<Sample> samples;
    const auto done = reader.for_each_message(
        [&](const Channel& channel, const Message& m) {
          samples.push_back({channel.topic, m.sequence, m.log_time_ns, m.publish_time_ns,
                             std::string(reinterpret_cast<const char*>(m.data.data()), m.data.size())});
        },
        on_damage);
    EXPECT_TRUE(done.ok()) << done.error().message;
    return samples;
  }

  static Status put(Writer& writer, std::uint16_t channel, const Sample& s) {
    return writer.write(
        {channel, s.sequence, s.log_time_ns, s.publish_time_ns, std::as_bytes(std::span(s.data))});
  }

  /// `count` messages on two topics, in chunks of about ten, and a metadata record; returns the messages in
  /// log order.
  std::vector<Sample> write_small_file(const std::filesystem::path& path, int count,
                                       WriterParams params = {}) const {
    params.chunk_span_ns = 10;
    auto writer = Writer::create(path, params);
    EXPECT_TRUE(writer.ok());
    const auto schema = writer->add_schema("t::A", "omgidl", "module t { struct A { long x; }; };");
    const auto a = writer->add_channel(*schema, "A", "cdr", {{"keyed", "true"}});
    const auto b = writer->add_channel(0, "A#lifecycle", "json");
    std::vector<Sample> written;
    for (int i = 0; i < count; ++i) {
      const bool on_a = i % 3 != 0;
      const auto n = static_cast<std::uint32_t>(i);
      written.push_back({on_a ? "A" : "A#lifecycle", n, 1000u + n, 900u + n, "payload " + std::to_string(i)});
      EXPECT_TRUE(put(*writer, on_a ? *a : *b, written.back()).ok());
    }
    EXPECT_TRUE(writer->write_metadata({"counters", {{"A", "received=1"}}}).ok());
    EXPECT_TRUE(writer->finish().ok());
    return written;
  }

 private:
  static std::string test_name() { return ::testing::UnitTest::GetInstance()->current_test_info()->name(); }
  std::filesystem::path folder_;
};

}  // namespace swallowtail::mcap
