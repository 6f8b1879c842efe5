#include "bem/linalg/blas_threads.h"

extern "C" void openblas_set_num_threads(int threads);

namespace palpa::bem {

void useOneBlasThread() {
  static const bool once = (openblas_set_num_threads(1), true);
  static_cast<void>(once);
}

}  // namespace palpa::bem
