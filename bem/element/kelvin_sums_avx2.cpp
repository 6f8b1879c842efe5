#include "bem/element/kelvin_sums_loop.h"

namespace palpa::bem {

void sumKernelsAvx2(const SumKernelsTask& task) {
  detail::sumKernels<xsimd::fma3<xsimd::avx2>>(task);
}
void addSumsAvx2(const AddSumsTask& task) {
  detail::addSums<xsimd::fma3<xsimd::avx2>>(task);
}
void makeBlocksUAvx2(const MakeBlocksTask& task) {
  detail::makeBlocks<xsimd::fma3<xsimd::avx2>, detail::BlockU>(task);
}
void makeBlocksTAvx2(const MakeBlocksTask& task) {
  detail::makeBlocks<xsimd::fma3<xsimd::avx2>, detail::BlockT>(task);
}

}  // namespace palpa::bem
