#include "tools/bench/seeds/claims.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "planner/base/rng.hpp"
#include "tools/bench/core/statistics.hpp"

namespace swallowtail::bench {
namespace {

constexpr std::size_t kResamples = 2000;

Claim undecidable(const std::string& experiment, const std::string& source, const std::string& sentence,
                  const std::string& why) {
  return {experiment, source, sentence, Verdict::kNotDecidable, why};
}

Claim sourced(Claim claim, const std::string& source, const std::string& sentence) {
  claim.source = source;
  claim.sentence = sentence;
  return claim;
}

std::vector<Claim> boa_in_the_plane(const std::string& e, const std::vector<Row>& rows) {
  const std::vector<std::string> both{"pso-seed", "aco-seed"};
  return {
      undecidable(e, "[BOA Fig. 12a]", "BOA falls from 314 to 295, PSO to 297, ACO to 304",
                  "obstacles and parameters are not printed"),
      sourced(lower_than(rows, e, "cost", "boa-seed", both), "[BOA Fig. 12a]",
              "BOA ends lower than PSO and ACO"),
      sourced(lower_than(rows, e, "cost", "pso-seed", {"aco-seed"}), "[BOA Fig. 12a]",
              "PSO ends lower than ACO"),
      sourced(lower_than(rows, e, "settled", "boa-seed", both), "[BOA Fig. 12a]",
              "BOA needs the fewest iterations (15 against 40 and 20)"),
      sourced(lower_than(rows, e, "cost", "boa", {"pso", "aco"}), "default forms",
              "boa ends lower than pso and aco"),
  };
}

std::vector<Claim> boa_in_space(const std::string& e, const std::vector<Row>& rows) {
  const std::vector<std::string> both{"pso-seed", "aco-seed"};
  std::vector<Claim> claims{
      undecidable(e, "[BOA Fig. 12c]", "BOA falls from 265 to 246, PSO from 254 to 251, ACO from 257 to 254",
                  "obstacles and parameters are not printed"),
      sourced(lower_than(rows, e, "cost", "boa-seed", both), "[BOA Fig. 12c]",
              "BOA ends lower than PSO and ACO"),
      sourced(lower_than(rows, e, "cost", "pso-seed", {"aco-seed"}), "[BOA Fig. 12c]",
              "PSO ends lower than ACO"),
      sourced(lower_than(rows, e, "settled", "pso-seed", {"boa-seed", "aco-seed"}), "[BOA Fig. 12c]",
              "PSO stops improving first (10 iterations against 32 and 30)"),
      sourced(lower_than(rows, e, "cpu", "boa-seed", both), "[BOA Fig. 14]", "BOA takes the least time"),
  };
  for (const char* algorithm : {"boa-seed", "pso-seed", "aco-seed"}) {
    claims.push_back(sourced(lower_than(rows, e, "cost", std::string(algorithm) + ", tuned",
                                        {std::string(algorithm) + ", random"}),
                             "[BOA Fig. 13]",
                             std::string("tuned parameters lower the cost of ") + algorithm));
  }
  claims.push_back(
      sourced(lower_than(rows, e, "cost", "boa-seed, tuned", {"pso-seed, tuned", "aco-seed, tuned"}),
              "[BOA Fig. 13, 14]", "BOA ends lowest with tuned parameters too"));
  claims.push_back(sourced(lower_than(rows, e, "cost", "boa", {"pso", "aco"}), "default forms",
                           "boa ends lower than pso and aco"));
  return claims;
}

std::vector<Claim> boa_over_ground(const std::string& e, const std::vector<Row>& rows,
                                   const std::string& source) {
  const std::vector<std::string> both{"pso-seed", "aco-seed"};
  return {sourced(lower_than(rows, e, "cost", "boa-seed", both), source,
                  "BOA's path is better than PSO's and ACO's"),
          sourced(lower_than(rows, e, "cpu", "boa-seed", both), "[BOA 9]", "BOA takes the least time"),
          sourced(lower_than(rows, e, "cost", "boa", {"pso", "aco"}), "default forms",
                  "boa ends lower than pso and aco")};
}

std::vector<Claim> pso_among_spheres(const std::string& e, const std::vector<Row>& rows, double printed) {
  const std::string source = printed < 16.0 ? "[PSO Fig. 4]" : "[PSO Fig. 5]";
  const std::string sentence = fmt::format("a path of {:.2f} with M = 200 and 50 iterations", printed);
  Claim published = sourced(reaches(rows, e, "length", "pso-seed", printed), source, sentence);
  published.evidence += "; the document prints no spheres, ours leave its own path free";
  return {published, sourced(reaches(rows, e, "length", "pso", printed), "default form", sentence),
          sourced(lower_than(rows, e, "cost", "pso", {"pso-seed"}), "default form",
                  "pso ends lower than pso-seed")};
}

std::vector<Claim> ibabc_in_its_box(const std::string& e, const std::vector<Row>& rows) {
  return {undecidable(e, "[IBABC, effects]", "converges faster and more exactly than plain ABC",
                      "no result, scene or parameter is printed, and the formulas are lost"),
          sourced(lower_than(rows, e, "cost", "ibabc", {"ibabc-seed"}), "default form",
                  "ibabc ends lower than ibabc-seed")};
}

}  // namespace

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kReproduced:
      return "reproduced";
    case Verdict::kNotReproduced:
      return "not reproduced";
    case Verdict::kNotDecidable:
      break;
  }
  return "not decidable";
}

Claim lower_than(const std::vector<Row>& rows, const std::string& experiment, const std::string& metric,
                 const std::string& subject, const std::vector<std::string>& others) {
  Claim claim;
  claim.experiment = experiment;
  const std::vector<double> own = values_of(rows, subject, experiment, metric);
  std::vector<double> p_values;
  std::vector<double> shares;
  std::string numbers = fmt::format("median {}: {} {}", metric, subject, significant(median_of(own), 5));
  for (const std::string& other : others) {
    const std::vector<double> theirs = values_of(rows, other, experiment, metric);
    if (own.empty() || theirs.empty()) {
      claim.evidence = "not run: " + (own.empty() ? subject : other);
      return claim;
    }
    p_values.push_back(mann_whitney(own, theirs).p_value);
    shares.push_back(share_smaller(own, theirs));
    numbers += fmt::format(", {} {}", other, significant(median_of(theirs), 5));
  }
  const std::vector<double> raised = holm(p_values);
  bool lower = true;
  for (std::size_t i = 0; i < others.size(); ++i) {
    lower = lower && raised[i] < kClaimLevel && shares[i] > 0.5;
    numbers += fmt::format("; lower than {} in {:.0f} % of pairs, p = {}", others[i], 100.0 * shares[i],
                           significant(raised[i], 2));
  }
  claim.verdict = lower ? Verdict::kReproduced : Verdict::kNotReproduced;
  claim.evidence = fmt::format("{} (n = {})", numbers, own.size());
  return claim;
}

Claim reaches(const std::vector<Row>& rows, const std::string& experiment, const std::string& metric,
              const std::string& subject, double value) {
  Claim claim;
  claim.experiment = experiment;
  const std::vector<double> own = values_of(rows, subject, experiment, metric);
  if (own.empty()) {
    claim.evidence = "not run: " + subject;
    return claim;
  }
  Rng rng(own.size());
  const Interval interval = bootstrap_median(own, 0.95, kResamples, rng);
  const auto hits = std::ranges::count_if(own, [value](double v) { return v <= value; });
  claim.verdict = interval.high <= value ? Verdict::kReproduced : Verdict::kNotReproduced;
  claim.evidence = fmt::format("median {} {}, 95 % interval {} … {}; at most {:.2f} in {} of {} seeds",
                               metric, significant(median_of(own), 5), significant(interval.low, 5),
                               significant(interval.high, 5), value, hits, own.size());
  return claim;
}

std::vector<Claim> claims_of(const std::string& experiment, const std::vector<Row>& rows) {
  if (experiment == "boa_2d") return boa_in_the_plane(experiment, rows);
  if (experiment == "boa_3d") return boa_in_space(experiment, rows);
  if (experiment == "boa_mountains") return boa_over_ground(experiment, rows, "[BOA Fig. 10]");
  if (experiment == "boa_mixed") return boa_over_ground(experiment, rows, "[BOA Fig. 6, 11]");
  if (experiment == "pso_five") return pso_among_spheres(experiment, rows, 15.74);
  if (experiment == "pso_ten") return pso_among_spheres(experiment, rows, 16.50);
  if (experiment == "ibabc_box") return ibabc_in_its_box(experiment, rows);
  return {};
}

Table to_table(const std::vector<Claim>& claims) {
  Table table;
  table.title = "What the documents claim, and what is measured here";
  table.columns = {"experiment", "source", "claim", "verdict", "evidence"};
  for (const Claim& c : claims)
    table.rows.push_back({c.experiment, c.source, c.sentence, name(c.verdict), c.evidence});
  return table;
}

}  // namespace swallowtail::bench
