#include "tools/cli/statistics.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace swallowtail::cli {

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  Spread out;
  out.min = values.front();
  out.max = values.back();
  out.median = values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  out.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return out;
}

nlohmann::ordered_json spread_json(std::vector<double> values) {
  if (values.empty()) return nullptr;
  const Spread spread = spread_of(std::move(values));
  return {{"min", spread.min}, {"median", spread.median}, {"mean", spread.mean}, {"max", spread.max}};
}

}  // namespace swallowtail::cli
