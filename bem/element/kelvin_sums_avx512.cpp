#include "bem/element/kelvin_sums_loop.h"

namespace palpa::bem {

void sumKernelsAvx512(const SumKernelsTask& task) {
  detail::sumKernels<xsimd::avx512f>(task);
}
void makeBlocksUAvx512(const MakeBlocksTask& task) {
  detail::makeBlocks<xsimd::avx512f, detail::BlockU>(task);
}
void makeBlocksTAvx512(const MakeBlocksTask& task) {
  detail::makeBlocks<xsimd::avx512f, detail::BlockT>(task);
}

}  // namespace palpa::bem
