#pragma once

#include <string>
#include <vector>

#include "tools/mission/check/flight_check.hpp"

namespace swallowtail::check {

/// Gathers findings; those of one kind and culprit that follow each other within three seconds are one, kept
/// at its worst instant.
class Findings {
 public:
  void add(double time_s, const char* kind, const P3& where_m, const std::string& by, double badness,
           std::string detail);
  /// `format` takes two doubles.
  void add(double time_s, const char* kind, const P3& where_m, const std::string& by, double badness,
           const char* format, double value, double limit);
  /// All of them in time.
  std::vector<Finding> take();

 private:
  struct Entry {
    Finding finding;
    double badness = 0.0;
    double last_s = 0.0;
  };
  std::vector<Entry> entries_;
};

}  // namespace swallowtail::check
