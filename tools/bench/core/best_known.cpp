#include "tools/bench/core/best_known.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include <fmt/core.h>

#include "tools/cli/output.hpp"

namespace swallowtail::bench {
namespace {

constexpr const char* kHeader = "case,metric,value,unit,obtained";
constexpr std::uintmax_t kMaxBytes = 1U << 20U;

/// The first four cells and the rest of the line.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t from = 0;
  while (cells.size() < 4) {
    const std::size_t comma = line.find(',', from);
    if (comma == std::string::npos) return cells;
    cells.push_back(line.substr(from, comma - from));
    from = comma + 1;
  }
  cells.push_back(line.substr(from));
  return cells;
}

std::optional<double> number_in(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool is_of(const BestKnown& entry, const std::string& case_name, const std::string& metric) {
  return entry.case_name == case_name && entry.metric == metric;
}

}  // namespace

Result<BestKnownFile> BestKnownFile::read(const std::string& path) {
  const auto text = cli::read_text(path, kMaxBytes);
  if (!text) return text.error();
  return parse(*text, path);
}

Result<BestKnownFile> BestKnownFile::parse(const std::string& text, const std::string& name) {
  BestKnownFile file;
  std::istringstream lines(text);
  bool header_seen = false;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty()) continue;
    if (line.front() == '#') {
      file.comments_.push_back(line);
    } else if (!header_seen) {
      if (line != kHeader) return bad_input(fmt::format("{}:{}: must be '{}'.", name, number, kHeader));
      header_seen = true;
    } else {
      const auto cells = cells_of(line);
      if (cells.size() != 5) return bad_input(fmt::format("{}:{}: must have five cells.", name, number));
      const auto value = number_in(cells[2]);
      if (!value)
        return bad_input(
            fmt::format("{}:{}: the value '{}' must be a finite number.", name, number, cells[2]));
      if (file.find(cells[0], cells[1]))
        return bad_input(
            fmt::format("{}:{}: {}, {} stands there already.", name, number, cells[0], cells[1]));
      file.entries_.push_back({cells[0], cells[1], *value, cells[3], cells[4]});
    }
  }
  return file;
}

std::optional<BestKnown> BestKnownFile::find(const std::string& case_name, const std::string& metric) const {
  const auto entry =
      std::ranges::find_if(entries_, [&](const BestKnown& e) { return is_of(e, case_name, metric); });
  if (entry == entries_.end()) return std::nullopt;
  return *entry;
}

bool BestKnownFile::improve(const BestKnown& candidate) {
  if (!std::isfinite(candidate.value)) return false;
  const auto entry = std::ranges::find_if(
      entries_, [&](const BestKnown& e) { return is_of(e, candidate.case_name, candidate.metric); });
  if (entry == entries_.end()) {
    entries_.push_back(candidate);
    return true;
  }
  if (candidate.value >= entry->value - kRelativeStep * std::abs(entry->value)) return false;
  *entry = candidate;
  return true;
}

std::string BestKnownFile::text() const {
  std::string text;
  for (const std::string& comment : comments_) text += comment + "\n";
  text += std::string(kHeader) + "\n";
  for (const BestKnown& e : entries_)
    text += fmt::format("{},{},{},{},{}\n", e.case_name, e.metric, e.value, e.unit, e.obtained);
  return text;
}

}  // namespace swallowtail::bench
