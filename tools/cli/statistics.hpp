#pragma once

#include <vector>

#include <nlohmann/json.hpp>

namespace swallowtail::cli {

/// Figures of a list of measurements; all 0 for an empty one.
struct Spread {
  double min = 0.0;
  double median = 0.0;
  double mean = 0.0;
  double max = 0.0;
};

Spread spread_of(std::vector<double> values);

/// null for an empty list.
nlohmann::ordered_json spread_json(std::vector<double> values);

}  // namespace swallowtail::cli
