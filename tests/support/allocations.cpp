#include "tests/support/allocations.hpp"

#include <atomic>
#include <cstdlib>

namespace {
std::atomic<std::uint64_t> count{0};
}

#if SWALLOWTAIL_COUNTS_ALLOCATIONS
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* __libc_memalign(std::size_t, std::size_t);
extern "C" void* malloc(std::size_t size) noexcept {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_memalign(alignment, size);
}
#endif

namespace swallowtail::test {

std::uint64_t allocations() { return count.load(); }

}  // namespace swallowtail::test
