#include "bem/compressed/block_products_loop.h"

namespace palpa::bem {

void addBlockProductAvx512(const BlockProductTask<PackedBlock>& task) {
  detail::addBlockProduct<xsimd::avx512f>(task);
}

void addBlockProductAvx512(const BlockProductTask<PackedSymmetricBlock>& task) {
  detail::addBlockProduct<xsimd::avx512f>(task);
}

}  // namespace palpa::bem
