// All of the batch kernel's source in its order; batch_kernel.cpp includes it once for each kind of processor.
// clang-format off
#include "planner/kernels/detail/vector_real.inl"
#include "planner/kernels/detail/signed_distance.inl"
#include "planner/kernels/detail/batch_loops.inl"
#include "planner/kernels/detail/terrain_loops.inl"
