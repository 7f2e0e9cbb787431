#include "tools/record/report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace swallowtail::record {
namespace {

double duration_s(const SessionSummary& summary) {
  return static_cast<double>(summary.end_ns - summary.start_ns) * 1e-9;
}

}  // namespace

std::string summary_text(const Options& options, const SessionSummary& summary) {
  std::string text =
      fmt::format("{}: {} messages in {:.1f} s, {:.2f} MB\n", options.output.string(), summary.messages,
                  duration_s(summary), static_cast<double>(summary.file_bytes) * 1e-6);
  text += fmt::format("{:<18} {:>9} {:>9} {:>8} {:>8} {:>12}\n", "topic", "samples", "lifecycle", "lost",
                      "dropped", "QoS mismatch");
  for (std::size_t i = 0; i < summary.topics.size(); ++i) {
    const TopicCounters& c = summary.topics[i];
    text += fmt::format("{:<18} {:>9} {:>9} {:>8} {:>8} {:>12}\n", options.topics[i].name, c.samples,
                        c.lifecycle_events, c.lost, c.dropped, c.incompatible_qos);
  }
  return text;
}

std::string summary_json(const Options& options, const SessionSummary& summary) {
  nlohmann::json json{{"status", "done"},
                      {"file", options.output.string()},
                      {"domain", options.domain},
                      {"messages", summary.messages},
                      {"duration_s", duration_s(summary)},
                      {"file_bytes", summary.file_bytes},
                      {"queue_most_bytes", summary.queue_most_bytes},
                      {"topics", nlohmann::json::array()}};
  for (std::size_t i = 0; i < summary.topics.size(); ++i) {
    const TopicCounters& c = summary.topics[i];
    json["topics"].push_back({{"topic", options.topics[i].name},
                              {"samples", c.samples},
                              {"lifecycle_events", c.lifecycle_events},
                              {"lost", c.lost},
                              {"dropped", c.dropped},
                              {"incompatible_qos", c.incompatible_qos}});
  }
  return json.dump(2);
}

}  // namespace swallowtail::record
