#include "tools/mission/check/findings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace swallowtail::check {
namespace {

constexpr double kSameStretch_s = 3.0;

}  // namespace

void Findings::add(double time_s, const char* kind, const P3& where_m, const std::string& by, double badness,
                   const char* format, double value, double limit) {
  char detail[160];
  std::snprintf(detail, sizeof detail, format, value, limit);
  add(time_s, kind, where_m, by, badness, std::string(detail));
}

void Findings::add(double time_s, const char* kind, const P3& where_m, const std::string& by, double badness,
                   std::string detail) {
  for (auto& entry : entries_) {
    if (entry.finding.kind != kind || entry.finding.by != by ||
        std::abs(time_s - entry.last_s) > kSameStretch_s)
      continue;
    entry.last_s = time_s;
    if (badness > entry.badness) entry = {{time_s, kind, where_m, by, std::move(detail)}, badness, time_s};
    return;
  }
  entries_.push_back({{time_s, kind, where_m, by, std::move(detail)}, badness, time_s});
}

std::vector<Finding> Findings::take() {
  std::vector<Finding> all;
  for (auto& entry : entries_) all.push_back(std::move(entry.finding));
  entries_.clear();
  std::sort(all.begin(), all.end(), [](const Finding& a, const Finding& b) { return a.time_s < b.time_s; });
  return all;
}

}  // namespace swallowtail::check
