#include "bem/spline/spline_kernel_loop.h"

namespace palpa::bem {

void placePointsAvx512(const PlacePointsTask& task) {
  detail::placePoints<xsimd::avx512f>(task);
}
void tabulateAvx512(const TabulateTask& task) {
  detail::tabulate<xsimd::avx512f>(task);
}
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
