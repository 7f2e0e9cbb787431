#include "planner/kernels/detail/batch_kernel.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#include <immintrin.h>
#endif

#include <cstring>
#include <limits>

#include "planner/kernels/detail/shapes.hpp"

// One source, compiled once for each width of registers. The target is set for whole functions rather than
// through ifunc resolvers, which run before the sanitizers are ready. None contracts into fused
// multiply-adds (-ffp-contract=off).
namespace swallowtail::planner::detail {

namespace plain {
namespace {
#include "planner/kernels/detail/batch_source.inl"
}  // namespace
}  // namespace plain

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SWALLOWTAIL_WIDE_KERNELS 1
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
namespace {
#include "planner/kernels/detail/batch_source.inl"
}  // namespace
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f")
namespace avx512 {
namespace {
#include "planner/kernels/detail/batch_source.inl"
}  // namespace
}  // namespace avx512
#pragma GCC pop_options
#endif

std::span<const BatchKernel> batch_kernels() {
  static constexpr BatchKernel kKernels[] = {
      {"plain", plain::add_violation, plain::distances, plain::axis_distance, plain::least_height,
       plain::length_below, plain::add_length},
#ifdef SWALLOWTAIL_WIDE_KERNELS
      {"avx2", avx2::add_violation, avx2::distances, avx2::axis_distance, avx2::least_height,
       avx2::length_below, avx2::add_length},
      {"avx512f", avx512::add_violation, avx512::distances, avx512::axis_distance, avx512::least_height,
       avx512::length_below, avx512::add_length},
#endif
  };
  static const std::size_t kUsable = [] {
#ifdef SWALLOWTAIL_WIDE_KERNELS
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("avx512f")) return std::size_t{3};
    if (__builtin_cpu_supports("avx2")) return std::size_t{2};
#endif
    return std::size_t{1};
  }();
  return std::span(kKernels).first(kUsable);
}

}  // namespace swallowtail::planner::detail
