#include "base/freed_memory.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace palpa {

void returnFreedMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace palpa
