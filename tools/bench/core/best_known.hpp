#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/base/result.hpp"

namespace swallowtail::bench {

/// The best value that anybody has found for a case, to be minimised, and how it was obtained.
struct BestKnown {
  std::string case_name;
  std::string metric;
  double value = 0.0;
  std::string unit;
  std::string obtained;
};

/// The file of best known values: CSV under the header case,metric,value,unit,obtained; `obtained` is the
/// rest of the line. Lines that begin with '#' are kept.
class BestKnownFile {
 public:
  /// Errors name file and line: unreadable, another header, too few cells, a value that is no finite number,
  /// a case and metric that stand there already.
  static Result<BestKnownFile> read(const std::string& path);
  static Result<BestKnownFile> parse(const std::string& text, const std::string& name);

  /// Empty: nothing is known.
  std::optional<BestKnown> find(const std::string& case_name, const std::string& metric) const;
  /// Takes a value that is lower than the known one by more than `kRelativeStep`, or that is the first of its
  /// case; false: it is not.
  bool improve(const BestKnown& candidate);
  std::string text() const;
  const std::vector<BestKnown>& entries() const { return entries_; }

  /// Less is rounding.
  static constexpr double kRelativeStep = 1e-9;

 private:
  std::vector<std::string> comments_;
  std::vector<BestKnown> entries_;
};

}  // namespace swallowtail::bench
