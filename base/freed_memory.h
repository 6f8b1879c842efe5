#pragma once

namespace palpa {

/// Returns the memory that was freed, but is kept for further allocations, to the system. For the
/// end of a phase that needed much temporary memory, before one that keeps much. Takes some
/// milliseconds per gigabyte; does nothing with another allocator than glibc's.
void returnFreedMemory();

}  // namespace palpa
