#include "bem/quadratic/quadratic_kernel_loop.h"

namespace palpa::bem {

void placeOnTriangleAvx512(const PlaceOnTriangleTask& task) {
  detail::placeOnTriangle<xsimd::avx512f>(task);
}
void triangleBasisAvx512(const TriangleBasisTask& task) {
  detail::triangleBasis<xsimd::avx512f>(task);
}

}  // namespace palpa::bem
