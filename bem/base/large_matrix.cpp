#include "bem/base/large_matrix.h"

#include <sys/mman.h>

#include <memory>
#include <new>

namespace palpa::bem::detail {

namespace {
constexpr std::size_t kHugePage = std::size_t{1} << 21;

/// Rounds up to whole huge pages from half a huge page on: clearing one takes less time than the
/// faults of its 512 small pages.
std::size_t inWholePages(std::size_t bytes) {
  return bytes < kHugePage / 2 ? bytes : (bytes + kHugePage - 1) / kHugePage * kHugePage;
}
}  // namespace

void* allocatePages(std::size_t bytes) {
  const std::size_t size = inWholePages(bytes), slack = size >= kHugePage ? kHugePage : 0;
  void* const begin =
      mmap(nullptr, size + slack, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (begin == MAP_FAILED) throw std::bad_alloc();
  void* memory = begin;
  if (slack > 0) {
    std::size_t space = size + slack;
    std::align(kHugePage, size, memory, space);
    const std::size_t before = size + slack - space, after = space - size;
    if (before > 0) munmap(begin, before);
    if (after > 0) munmap(static_cast<char*>(memory) + size, after);
  }
  madvise(memory, size, MADV_HUGEPAGE);  // a hint; without huge pages everything is only slower
  return memory;
}

void releasePages(void* memory, std::size_t bytes) noexcept {
  munmap(memory, inWholePages(bytes));
}

}  // namespace palpa::bem::detail
