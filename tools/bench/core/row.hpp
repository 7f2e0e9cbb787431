#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swallowtail::bench {

/// One measured figure; what every bench is made of.
struct Row {
  std::string subject;    ///< what was measured: "plan_path", "ompl InformedRRT*"
  std::string case_name;  ///< on what
  std::uint64_t seed = 0;
  std::string metric;  ///< "length", "time_to_1_percent"
  double value = 0.0;  ///< infinite: never reached
  std::string unit;    ///< "m", "ms", "" for a pure number
};

/// Values of one metric of one subject on one case, in the order of the rows.
std::vector<double> values_of(const std::vector<Row>& rows, const std::string& subject,
                              const std::string& case_name, const std::string& metric);

}  // namespace swallowtail::bench
