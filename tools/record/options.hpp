#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "qos/topics.hpp"
#include "tools/record/mcap/compression.hpp"

namespace swallowtail::record {

struct Options {
  std::filesystem::path output;
  std::uint32_t domain = 0;
  std::vector<TopicQos> topics;
  mcap::Compression compression = mcap::Compression::kZstd;
  bool json = false;
  bool quiet = false;
};

/// The options, or the exit code of a program that has said all there is to say (help, wrong usage).
std::variant<Options, int> parse_options(int argc, const char* const* argv);

}  // namespace swallowtail::record
