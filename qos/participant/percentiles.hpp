#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace swallowtail {

/// Percentiles of the newest `capacity` values, and the greatest of all. Memory is taken at construction
/// only; safe to call from any thread.
class Percentiles {
 public:
  struct Summary {
    double p50 = 0.0;
    double p99 = 0.0;
    double max = 0.0;         ///< of every value ever added
    std::uint64_t count = 0;  ///< values ever added
  };

  /// A capacity of 0 is taken as 1.
  explicit Percentiles(std::size_t capacity = 1024);

  /// Values that are not finite are left out.
  void add(double value);

  /// Nearest rank: the least value with at least the given share of the window at or below it. All zero while
  /// empty.
  Summary summary() const;

 private:
  mutable std::mutex mutex_;
  std::vector<double> ring_;
  mutable std::vector<double> sorted_;
  std::size_t next_ = 0;
  std::size_t held_ = 0;
  double max_ = 0.0;
  std::uint64_t count_ = 0;
};

}  // namespace swallowtail
