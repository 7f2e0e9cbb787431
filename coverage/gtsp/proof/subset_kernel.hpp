#pragma once

#include <cstdint>

namespace swallowtail::gtsp::proof {

/// Lanes that the kernels below work on at once; widths are multiples of it.
inline constexpr int kSubsetLanes = 8;

/// What stands for "no way": two of them still are no overflow.
inline constexpr std::int32_t kNoWay32 = 1 << 29;

/// least[lane] = the least over i < count of value[i] + cost[from[i]·width + lane], at most kNoWay32 or
/// infinity: one step of ways on from many vertices to all of a cluster. With AVX2 where the machine has it;
/// the results are the same bit for bit.
void least_ways_on(const std::int32_t* value, const int* from, int count, const std::int32_t* cost, int width,
                   std::int32_t* least);
void least_ways_on(const double* value, const int* from, int count, const double* cost, int width,
                   double* least);

/// The least of a[i] + b[i], infinity for none; as above, the same on every machine.
double least_sum(const double* a, const double* b, int count);

}  // namespace swallowtail::gtsp::proof
