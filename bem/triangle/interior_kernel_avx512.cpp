#include "bem/triangle/interior_kernel_loop.h"

namespace palpa::bem {

void sumInteriorAvx512(const InteriorSumTask& task) {
  detail::sumInterior<xsimd::avx512f>(task);
}

}  // namespace palpa::bem
