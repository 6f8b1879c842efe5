#include "bem/triangle/interior_kernel_loop.h"

namespace palpa::bem {

void sumInteriorAvx2(const InteriorSumTask& task) {
  detail::sumInterior<xsimd::fma3<xsimd::avx2>>(task);
}

}  // namespace palpa::bem
