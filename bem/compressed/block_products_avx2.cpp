#include "bem/compressed/block_products_loop.h"

namespace palpa::bem {

void addBlockProductAvx2(const BlockProductTask<PackedBlock>& task) {
  detail::addBlockProduct<xsimd::fma3<xsimd::avx2>>(task);
}

void addBlockProductAvx2(const BlockProductTask<PackedSymmetricBlock>& task) {
  detail::addBlockProduct<xsimd::fma3<xsimd::avx2>>(task);
}

}  // namespace palpa::bem
