#include "bem/spline/spline_kernel_loop.h"

namespace palpa::bem {

void placePointsAvx2(const PlacePointsTask& task) {
  detail::placePoints<xsimd::fma3<xsimd::avx2>>(task);
}
void tabulateAvx2(const TabulateTask& task) {
  detail::tabulate<xsimd::fma3<xsimd::avx2>>(task);
}

}  // namespace palpa::bem
