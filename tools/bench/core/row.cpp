#include "tools/bench/core/row.hpp"

namespace swallowtail::bench {

std::vector<double> values_of(const std::vector<Row>& rows, const std::string& subject,
                              const std::string& case_name, const std::string& metric) {
  std::vector<double> values;
  for (const Row& row : rows) {
    if (row.subject == subject && row.case_name == case_name && row.metric == metric)
      values.push_back(row.value);
  }
  return values;
}

}  // namespace swallowtail::bench
