#include "bem/spline/spline_kernel_loop.h"

namespace palpa::bem {

void placePointsAvx512(const PlacePointsTask& task) {
  detail::placePoints<xsimd::avx512f>(task);
}
void tabulateAvx512(const TabulateTask& task) {
  detail::tabulate<xsimd::avx512f>(task);
}

}  // namespace palpa::bem
