#include "bem/quadratic/quadratic_kernel_loop.h"

namespace palpa::bem {

void placeOnTriangleAvx2(const PlaceOnTriangleTask& task) {
  detail::placeOnTriangle<xsimd::fma3<xsimd::avx2>>(task);
}
void triangleBasisAvx2(const TriangleBasisTask& task) {
  detail::triangleBasis<xsimd::fma3<xsimd::avx2>>(task);
}

}  // namespace palpa::bem
