#include "bem/spline/spline_kernel_loop.h"

namespace palpa::bem {

void placePointsBaseline(const PlacePointsTask& task) {
  detail::placePoints<xsimd::default_arch>(task);
}
void tabulateBaseline(const TabulateTask& task) {
  detail::tabulate<xsimd::default_arch>(task);
}

}  // namespace palpa::bem
