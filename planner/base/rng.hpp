#pragma once

#include <array>
#include <cstdint>

namespace swallowtail {

/// The only source of randomness: xoshiro256** seeded through splitmix64 [BLACKMAN-VIGNA]. The same seed
/// gives the same numbers on every platform; the standard library's distributions do not, so the few needed
/// stand here.
class Rng {
 public:
  using result_type = std::uint64_t;

  explicit Rng(std::uint64_t seed);

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }
  result_type operator()();

  /// Uniform in [0, 1).
  double uniform();
  /// Uniform in [lo, hi).
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  /// Uniform in 0 … n − 1; n ≥ 1. Unbiased (Lemire's method).
  std::uint64_t below(std::uint64_t n);
  /// Standard normal (Marsaglia's polar method).
  double normal();
  /// An independent generator for the stream `index`: what thread or candidate `index` draws does not depend
  /// on the others.
  Rng split(std::uint64_t index) const;

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_normal_ = 0.0;
  bool has_spare_normal_ = false;
};

}  // namespace swallowtail
