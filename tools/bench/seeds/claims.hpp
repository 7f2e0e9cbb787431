#pragma once

#include <string>
#include <vector>

#include "tools/bench/core/row.hpp"
#include "tools/bench/core/table.hpp"

namespace swallowtail::bench {

enum class Verdict { kReproduced, kNotReproduced, kNotDecidable };
const char* name(Verdict verdict);

/// A sentence printed in a document, and what the runs here say of it.
struct Claim {
  std::string experiment;
  std::string source;    ///< "[BOA Fig. 12a]"
  std::string sentence;  ///< what is claimed
  Verdict verdict = Verdict::kNotDecidable;
  std::string evidence;  ///< the numbers, or why there can be none
};

/// Level of every test, after Holm's correction among the tests of one claim.
inline constexpr double kClaimLevel = 0.05;

/// "`subject` has lower `metric` than each of `others`", by Mann–Whitney's test of its values over the seeds,
/// two-sided; reproduced when it is significantly lower than every one of them.
Claim lower_than(const std::vector<Row>& rows, const std::string& experiment, const std::string& metric,
                 const std::string& subject, const std::vector<std::string>& others);
/// "`subject` reaches `value`": reproduced when the whole 95 % bootstrap interval of the median is at most
/// it.
Claim reaches(const std::vector<Row>& rows, const std::string& experiment, const std::string& metric,
              const std::string& subject, double value);

/// What is printed for the experiment and can be looked at with these rows, and what cannot be decided.
std::vector<Claim> claims_of(const std::string& experiment, const std::vector<Row>& rows);

Table to_table(const std::vector<Claim>& claims);

}  // namespace swallowtail::bench
