#include "bem/large_matrix.h"

#include <sys/mman.h>

#include <new>

namespace palpa::bem::detail {

void* allocatePages(std::size_t bytes) {
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  madvise(memory, bytes,
          MADV_HUGEPAGE);  // a hint; without huge pages everything works, only slower
  return memory;
}

void releasePages(void* memory, std::size_t bytes) noexcept {
  munmap(memory, bytes);
}

}  // namespace palpa::bem::detail
