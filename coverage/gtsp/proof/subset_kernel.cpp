#include "coverage/gtsp/proof/subset_kernel.hpp"

#include <cstddef>
#include <cstring>
#include <limits>

namespace swallowtail::gtsp::proof {
namespace {

constexpr int kVectorBytes = 32;

template <class Cost>
struct Lanes;
template <>
struct Lanes<std::int32_t> {
  using Vector = std::int32_t __attribute__((vector_size(kVectorBytes)));
  static constexpr std::int32_t kNoWay = kNoWay32;
};
template <>
struct Lanes<double> {
  using Vector = double __attribute__((vector_size(kVectorBytes)));
  static constexpr double kNoWay = std::numeric_limits<double>::infinity();
};

/// As many vectors as lanes of one block hold, from where `cost` and `least` point to.
template <class Cost, int kBlock>
[[gnu::always_inline]] inline void relax_block(const Cost* value, const int* from, int count,
                                               const Cost* cost, int width, Cost* least) {
  using Vector = typename Lanes<Cost>::Vector;
  constexpr int kLanes = kVectorBytes / sizeof(Cost);
  constexpr int kVectors = kBlock / kLanes;
  Vector best[kVectors];
  for (int j = 0; j < kVectors; ++j) best[j] = Vector{} + Lanes<Cost>::kNoWay;
  for (int i = 0; i < count; ++i) {
    const Cost* const row = cost + static_cast<std::ptrdiff_t>(from[i]) * width;
    for (int j = 0; j < kVectors; ++j) {
      Vector sum;
      std::memcpy(&sum, row + j * kLanes, sizeof sum);
      sum += value[i];
      best[j] = sum < best[j] ? sum : best[j];
    }
  }
  std::memcpy(least, best, sizeof best);
}

template <class Cost>
[[gnu::always_inline]] inline void relax(const Cost* value, const int* from, int count, const Cost* cost,
                                         int width, Cost* least) {
  constexpr int kLarge = 3 * kSubsetLanes;
  int lane = 0;
  for (; width - lane >= kLarge; lane += kLarge)
    relax_block<Cost, kLarge>(value, from, count, cost + lane, width, least + lane);
  if (width - lane == 2 * kSubsetLanes)
    relax_block<Cost, 2 * kSubsetLanes>(value, from, count, cost + lane, width, least + lane);
  if (width - lane == kSubsetLanes)
    relax_block<Cost, kSubsetLanes>(value, from, count, cost + lane, width, least + lane);
}

[[gnu::always_inline]] inline double least_sum_of(const double* a, const double* b, int count) {
  using Vector = Lanes<double>::Vector;
  constexpr int kLanes = kVectorBytes / sizeof(double);
  constexpr int kBlock = 2 * kLanes;
  Vector best[2];
  best[0] = best[1] = Vector{} + Lanes<double>::kNoWay;
  int i = 0;
  for (; i + kBlock <= count; i += kBlock) {
    for (int j = 0; j < 2; ++j) {
      Vector left;
      Vector right;
      std::memcpy(&left, a + i + j * kLanes, sizeof left);
      std::memcpy(&right, b + i + j * kLanes, sizeof right);
      left += right;
      best[j] = left < best[j] ? left : best[j];
    }
  }
  double least = Lanes<double>::kNoWay;
  for (; i < count; ++i) least = a[i] + b[i] < least ? a[i] + b[i] : least;
  for (const Vector& lanes : best) {
    for (int j = 0; j < kLanes; ++j) least = lanes[j] < least ? lanes[j] : least;
  }
  return least;
}

template <class Cost>
using Relax = void (*)(const Cost*, const int*, int, const Cost*, int, Cost*);

template <class Cost>
void relax_plain(const Cost* value, const int* from, int count, const Cost* cost, int width, Cost* least) {
  relax(value, from, count, cost, width, least);
}

using LeastSum = double (*)(const double*, const double*, int);

double least_sum_plain(const double* a, const double* b, int count) { return least_sum_of(a, b, count); }

// The target is set for whole functions rather than through ifunc resolvers, which run before the sanitizers
// are ready.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
template <class Cost>
[[gnu::target("avx2")]] void relax_avx2(const Cost* value, const int* from, int count, const Cost* cost,
                                        int width, Cost* least) {
  relax(value, from, count, cost, width, least);
}

[[gnu::target("avx2")]] double least_sum_avx2(const double* a, const double* b, int count) {
  return least_sum_of(a, b, count);
}

LeastSum fastest_sum() { return __builtin_cpu_supports("avx2") ? least_sum_avx2 : least_sum_plain; }

template <class Cost>
Relax<Cost> fastest() {
  return __builtin_cpu_supports("avx2") ? relax_avx2<Cost> : relax_plain<Cost>;
}
#else
LeastSum fastest_sum() { return least_sum_plain; }

template <class Cost>
Relax<Cost> fastest() {
  return relax_plain<Cost>;
}
#endif

}  // namespace

void least_ways_on(const std::int32_t* value, const int* from, int count, const std::int32_t* cost, int width,
                   std::int32_t* least) {
  static const Relax<std::int32_t> kRelax = fastest<std::int32_t>();
  kRelax(value, from, count, cost, width, least);
}

void least_ways_on(const double* value, const int* from, int count, const double* cost, int width,
                   double* least) {
  static const Relax<double> kRelax = fastest<double>();
  kRelax(value, from, count, cost, width, least);
}

double least_sum(const double* a, const double* b, int count) {
  static const LeastSum kSum = fastest_sum();
  return kSum(a, b, count);
}

}  // namespace swallowtail::gtsp::proof
