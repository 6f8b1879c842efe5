#include "bem/compressed/block_products_loop.h"

namespace palpa::bem {

void addBlockProductBaseline(const BlockProductTask& task) {
  detail::addBlockProduct<xsimd::default_arch>(task);
}

}  // namespace palpa::bem
