#pragma once

#include <cstdint>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define SWALLOWTAIL_COUNTS_ALLOCATIONS 0
#else
#define SWALLOWTAIL_COUNTS_ALLOCATIONS 1
#endif

namespace swallowtail::test {

/// How often the program has asked for memory so far. Linking this replaces malloc and aligned_alloc, except
/// where a sanitizer owns them (SWALLOWTAIL_COUNTS_ALLOCATIONS is 0 then, and so is the answer).
std::uint64_t allocations();

}  // namespace swallowtail::test
