#include "allocation_counter.h"

#include <unistd.h>

#include <atomic>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>

namespace {

std::atomic<int> watched{0};
std::atomic<long> count{0};

void note() {
  const int thread = watched.load(std::memory_order_relaxed);
  if (thread != 0 && thread == ::gettid()) count.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

extern "C" {
void* __real_malloc(std::size_t bytes);
void* __wrap_malloc(std::size_t bytes) {
  note();
  return __real_malloc(bytes);
}
}

void* operator new(std::size_t bytes) {
  note();
  if (void* memory = __real_malloc(bytes > 0 ? bytes : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new[](std::size_t bytes) {
  return operator new(bytes);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace palpa::app::test {

void watchAllocations(int thread) {
  watched.store(0);
  count.store(0);
  watched.store(thread);
}

long allocations() {
  return count.load();
}

int threadNamed(const char* name) {
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string found;
    std::getline(std::ifstream(task.path() / "comm"), found);
    if (found != name) continue;
    const std::string number = task.path().filename();
    int thread = 0;
    std::from_chars(number.data(), number.data() + number.size(), thread);
    return thread;
  }
  return 0;
}

}  // namespace palpa::app::test
