#include "tools/record/options.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

#include "qos/options.hpp"
#include "tools/record/contract.hpp"

namespace swallowtail::record {
namespace {

constexpr int kUsageError = 2;
constexpr const char* kExamples = R"(Examples:
  swallowtail-record -o mission.mcap
  swallowtail-record -o flight.mcap --domain 7 --topics VehicleState,PathPlan,Obstacle
  swallowtail-record -o quick.mcap --compression none --json

Stops on Ctrl-C or SIGTERM and finishes the file; a recorder that is killed leaves a file that
reads up to the last half second. Exit codes: 0 done, 2 wrong usage or the file cannot be made,
4 the file could not be written (disk full) or DDS failed.)";

}  // namespace

std::variant<Options, int> parse_options(int argc, const char* const* argv) {
  Options options;
  std::vector<std::string> topics;
  CLI::App app{"Records the data contract's topics, from any vendor's writers, into an MCAP file."};
  app.footer(kExamples);
  app.add_option("-o,--output", options.output, "The file to write; one that is there is replaced")
      ->required();
  app.add_option("--domain", options.domain, "DDS domain")
      ->check(CLI::Range(0u, kMaxDomain))
      ->capture_default_str();
  app.add_option("--topics", topics, "Only these topics, separated by commas")->delimiter(',');
  std::string compression = "zstd";
  app.add_option("--compression", compression, "zstd or none")
      ->check(CLI::IsMember({"zstd", "none"}))
      ->capture_default_str();
  app.add_flag("--json", options.json, "Print the summary as one JSON document");
  app.add_flag("-q,--quiet", options.quiet, "Print nothing but errors (and the JSON)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageError;
  }
  options.compression = compression == "none" ? mcap::Compression::kNone : mcap::Compression::kZstd;
  for (const std::string& name : topics) {
    const TopicQos* topic = find_topic(name);
    if (topic == nullptr) {
      std::cerr << "swallowtail-record: the contract has no topic \"" << name << "\".\n";
      return kUsageError;
    }
    options.topics.push_back(*topic);
  }
  if (topics.empty()) options.topics.assign(kTopics.begin(), kTopics.end());
  return options;
}

}  // namespace swallowtail::record
