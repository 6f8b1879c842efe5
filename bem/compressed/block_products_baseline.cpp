#include "bem/compressed/block_products_loop.h"

namespace palpa::bem {

void addBlockProductBaseline(const BlockProductTask<PackedBlock>& task) {
  detail::addBlockProduct<xsimd::default_arch>(task);
}

void addBlockProductBaseline(const BlockProductTask<PackedSymmetricBlock>& task) {
  detail::addBlockProduct<xsimd::default_arch>(task);
}

}  // namespace palpa::bem
