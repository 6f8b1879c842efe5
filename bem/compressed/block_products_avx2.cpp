#include "bem/compressed/block_products_loop.h"

namespace palpa::bem {

void addBlockProductAvx2(const BlockProductTask& task) {
  detail::addBlockProduct<xsimd::fma3<xsimd::avx2>>(task);
}

}  // namespace palpa::bem
