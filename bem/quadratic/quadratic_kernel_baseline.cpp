#include "bem/quadratic/quadratic_kernel_loop.h"

namespace palpa::bem {

void placeOnTriangleBaseline(const PlaceOnTriangleTask& task) {
  detail::placeOnTriangle<xsimd::default_arch>(task);
}
void triangleBasisBaseline(const TriangleBasisTask& task) {
  detail::triangleBasis<xsimd::default_arch>(task);
}

}  // namespace palpa::bem
