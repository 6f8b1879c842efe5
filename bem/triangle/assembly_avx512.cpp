#include "bem/triangle/assembly_loop.h"

namespace palpa::bem {

using Avx512 = xsimd::avx512f;

void assembleRowsAvx512(const AssemblyTask<double>& task) {
  detail::assembleRows<Avx512>(task);
}
void assembleRowsAvx512(const AssemblyTask<float>& task) {
  detail::assembleRows<Avx512>(task);
}
void addProductAvx512(const ProductTask<double>& task) {
  detail::addProduct<Avx512>(task);
}
void addProductAvx512(const ProductTask<float>& task) {
  detail::addProduct<Avx512>(task);
}

}  // namespace palpa::bem
