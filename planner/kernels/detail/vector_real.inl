// kLanes doubles as one value. The compiler cuts it into what registers the surrounding target has; every
// operation is elementwise, so the bits do not depend on the cut.

using Real = double __attribute__((vector_size(sizeof(double) * kLanes)));
using Mask = long long __attribute__((vector_size(sizeof(long long) * kLanes)));

inline Real broadcast(double v) { return Real{v, v, v, v, v, v, v, v}; }
inline Real load(const double* from) {
  Real r;
  std::memcpy(&r, from, sizeof r);
  return r;
}
inline void store(const Real& r, double* to) { std::memcpy(to, &r, sizeof r); }
inline Real select(const Mask& m, const Real& a, const Real& b) { return m ? a : b; }
inline Real largest(const Real& a, const Real& b) { return a > b ? a : b; }
inline Real smallest(const Real& a, const Real& b) { return a < b ? a : b; }
inline Real absolute(const Real& a) { return a < broadcast(0.0) ? -a : a; }
inline bool any(const Mask& m) {
  long long joined = 0;
  for (int i = 0; i < kLanes; ++i) joined |= m[i];
  return joined != 0;
}
inline Real root(const Real& a) {
  Real r;
  for (int i = 0; i < kLanes; ++i) r[i] = __builtin_sqrt(a[i]);
  return r;
}

using Index = int __attribute__((vector_size(sizeof(int) * kLanes)));
using Narrow = float __attribute__((vector_size(sizeof(float) * kLanes)));

/// Without its fraction; numbers within the range of int.
inline Real whole(const Real& a) { return __builtin_convertvector(__builtin_convertvector(a, Index), Real); }
/// from[index] in each lane.
inline Real gather(const float* from, const Real& index) {
  const Index at = __builtin_convertvector(index, Index);
  Narrow values;
#ifdef __AVX2__
  __m256i offsets;
  std::memcpy(&offsets, &at, sizeof offsets);
  const __m256 found = _mm256_i32gather_ps(from, offsets, sizeof(float));
  std::memcpy(&values, &found, sizeof values);
#else
  for (int i = 0; i < kLanes; ++i) values[i] = from[at[i]];
#endif
  return __builtin_convertvector(values, Real);
}
