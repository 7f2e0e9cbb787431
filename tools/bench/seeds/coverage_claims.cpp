#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "tools/bench/core/statistics.hpp"
#include "tools/bench/seeds/coverage_experiments.hpp"

/// Which of [COV 5]'s sentences the rows bear out.
namespace swallowtail::bench {
namespace {

constexpr const char* kWith = "with heights";
constexpr const char* kWithout = "without heights";
constexpr double kNearlySame = 0.05;
constexpr double kFlat = 0.01;
/// Where the document itself saw the drop: 120 for M = 98.5.
constexpr double kLatestDrop = 1.25;
constexpr double kEndOfRange = 10.0;  ///< k

Claim said(Claim claim, const std::string& source, const std::string& sentence) {
  claim.source = source;
  claim.sentence = sentence;
  return claim;
}

Claim judged(const std::string& e, const std::string& source, const std::string& sentence, bool holds,
             std::string evidence) {
  return {e, source, sentence, holds ? Verdict::kReproduced : Verdict::kNotReproduced, std::move(evidence)};
}

Claim not_run(const std::string& e, const std::string& source, const std::string& sentence) {
  return {e, source, sentence, Verdict::kNotDecidable, "not run"};
}

Claim figures(const std::string& e, const std::string& source, const std::string& sentence) {
  return {e, source, sentence, Verdict::kNotDecidable, "the polygons are figures and cannot be recovered"};
}

double median_cost(const std::vector<Row>& rows, const std::string& subject, const std::string& e) {
  const auto values = values_of(rows, subject, e, "cost");
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : median_of(values);
}

std::vector<Claim> heights(const std::string& e, const std::vector<Row>& rows) {
  return {figures(e, "[COV 5.1]", "cost 1159 with heights, 1081 without"),
          said(lower_than(rows, e, "cost", kWithout, {kWith}), "[COV 5.1]",
               "the tour costs less without heights than with them")};
}

std::vector<Claim> safe_height(const std::string& e, const std::vector<Row>& rows) {
  const std::string safe = "at the safe height";
  const std::string sentence = "at the safe height only the one cell is covered as it should (2.47 %)";
  const auto covered = values_of(rows, safe, e, "covered");
  return {figures(e, "[COV 5.2]", "cost 1112 with heights, 1313 at the safe height"),
          said(lower_than(rows, e, "cost", kWith, {safe}), "[COV 5.2]",
               "flying each cell at its height costs less than all at the safe height"),
          covered.empty()
              ? not_run(e, "[COV 5.2]", sentence)
              : judged(e, "[COV 5.2]", sentence, quartiles_of(covered).max < 20.0,
                       fmt::format("{} % in the median, at most {} %", significant(median_of(covered), 3),
                                   significant(quartiles_of(covered).max, 3)))};
}

struct BatteryCurve {
  double first_units = std::numeric_limits<double>::infinity();  ///< first D_max / M with a tour
  double first_cost = 0.0;
  double least_cost = std::numeric_limits<double>::infinity();
  double cost_at_range_tenth = 0.0;  ///< at D_max = 2 M
  double cost_at_end = 0.0;          ///< at D_max = kM
  double change_beyond = 0.0;        ///< greatest, relative to cost_at_end
};

BatteryCurve curve_of(const std::vector<Row>& rows, const std::string& e, const std::string& ways) {
  BatteryCurve curve;
  for (const double units : battery_sweep()) {
    const double cost = median_cost(rows, battery_subject(ways, units), e);
    if (!std::isfinite(cost)) continue;
    if (std::isinf(curve.first_units)) {
      curve.first_units = units;
      curve.first_cost = cost;
    }
    curve.least_cost = std::min(curve.least_cost, cost);
    if (units == 2.0) curve.cost_at_range_tenth = cost;
    if (units == kEndOfRange) curve.cost_at_end = cost;
    if (units > kEndOfRange && curve.cost_at_end > 0.0)
      curve.change_beyond = std::max(curve.change_beyond, std::abs(cost / curve.cost_at_end - 1.0));
  }
  return curve;
}

std::vector<Claim> battery(const std::string& e, const std::vector<Row>& rows) {
  std::vector<Claim> claims;
  for (const char* ways : {kWithout, kWith}) {
    const std::string who = std::string(", ") + ways;
    const std::string opens = "D_max just above M opens the range" + who;
    const std::string drops = "most of the fall comes right after M" + who;
    const std::string floor = "from D_max = kM on the cost is at its floor" + who;
    if (values_of(rows, battery_subject(ways, kEndOfRange), e, "cost").empty()) {
      for (const std::string& sentence : {opens, drops, floor})
        claims.push_back(not_run(e, "[COV 5.3]", sentence));
      continue;
    }
    const BatteryCurve curve = curve_of(rows, e, ways);
    claims.push_back(
        judged(e, "[COV 5.3]", opens, curve.first_units >= 1.0 && curve.first_units <= kLatestDrop,
               fmt::format("no tour below {} M, printed 99 and 111 to 120 for M = 98.5", curve.first_units)));
    const double fall = curve.first_cost - curve.least_cost;
    const double early = curve.first_cost - curve.cost_at_range_tenth;
    claims.push_back(judged(
        e, "[COV 5.3]", drops, fall > 0.0 && early > 0.5 * fall,
        fmt::format("cost {} at {} M, {} at 2 M, least {}: {:.0f} % of the fall by 2 M",
                    significant(curve.first_cost), curve.first_units, significant(curve.cost_at_range_tenth),
                    significant(curve.least_cost), fall > 0.0 ? 100.0 * early / fall : 0.0)));
    claims.push_back(
        judged(e, "[COV 5.3]", floor,
               curve.cost_at_end <= (1.0 + kFlat) * curve.least_cost && curve.change_beyond <= kFlat,
               fmt::format("cost {} at kM, least {}, up to {:.2f} % different beyond",
                           significant(curve.cost_at_end), significant(curve.least_cost),
                           100.0 * curve.change_beyond)));
  }
  return claims;
}

std::vector<Claim> levels(const std::string& e, const std::vector<Row>& rows) {
  std::vector<Claim> claims;
  for (const char* ways : {kWithout, kWith}) {
    const auto k = [ways](int levels) { return level_subject(ways, levels); };
    const std::string who = std::string(", ") + ways;
    claims.push_back(
        said(lower_than(rows, e, "cost", k(10), {k(2)}), "[COV 5.4]", "k = 10 costs less than k = 2" + who));
    claims.push_back(said(lower_than(rows, e, "recharges", k(10), {k(2)}), "[COV 5.4]",
                          "k = 10 recharges less often than k = 2" + who));
    claims.push_back(
        said(lower_than(rows, e, "cpu", k(2), {k(10), k(20)}), "[COV 5.4]", "the time grows with k" + who));
    const std::string sentence = "beyond k = 10 little is gained" + who;
    const double at_2 = median_cost(rows, k(2), e);
    const double at_10 = median_cost(rows, k(10), e);
    const double at_20 = median_cost(rows, k(20), e);
    claims.push_back(std::isnan(at_20)
                         ? not_run(e, "[COV 5.4]", sentence)
                         : judged(e, "[COV 5.4]", sentence, at_10 <= (1.0 + kNearlySame) * at_20,
                                  fmt::format("median cost {} at k = 2, {} at 10, {} at 20",
                                              significant(at_2), significant(at_10), significant(at_20))));
  }
  return claims;
}

std::vector<Claim> neighbours(const std::string& e, const std::vector<Row>& rows) {
  std::vector<Claim> claims;
  for (const char* ways : {kWithout, kWith}) {
    const std::string who = std::string(", ") + ways;
    const std::string reduced = std::string(ways) + ", X = 5";
    const std::string full = std::string(ways) + ", full graph";
    claims.push_back(said(lower_than(rows, e, "cpu", reduced, {full}), "[COV 5.5]",
                          "X = 5 takes less time than the full graph" + who));
    const std::string sentence = "X = 5 costs nearly the same" + who;
    const double ratio = median_cost(rows, reduced, e) / median_cost(rows, full, e);
    claims.push_back(std::isnan(ratio) ? not_run(e, "[COV 5.5]", sentence)
                                       : judged(e, "[COV 5.5]", sentence, ratio <= 1.0 + kNearlySame,
                                                fmt::format("median cost times {:.4f}", ratio)));
  }
  return claims;
}

}  // namespace

std::vector<Claim> coverage_claims(const std::string& name, const std::vector<Row>& rows) {
  std::vector<std::string> cases;
  for (const Row& row : rows) {
    if (std::ranges::find(cases, row.case_name) == cases.end()) cases.push_back(row.case_name);
  }
  std::vector<Claim> claims;
  for (const std::string& e : cases) {
    std::vector<Claim> more;
    if (name == kCovHeights) more = heights(e, rows);
    if (name == kCovSafeHeight) more = safe_height(e, rows);
    if (name == kCovBattery) more = battery(e, rows);
    if (name == kCovLevels) more = levels(e, rows);
    if (name == kCovNeighbours) more = neighbours(e, rows);
    claims.insert(claims.end(), more.begin(), more.end());
  }
  return claims;
}

}  // namespace swallowtail::bench
