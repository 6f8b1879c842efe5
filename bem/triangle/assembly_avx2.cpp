#include "bem/triangle/assembly_loop.h"

namespace palpa::bem {

using Avx2 = xsimd::fma3<xsimd::avx2>;

void assembleRowsAvx2(const AssemblyTask<double>& task) {
  detail::assembleRows<Avx2>(task);
}
void assembleRowsAvx2(const AssemblyTask<float>& task) {
  detail::assembleRows<Avx2>(task);
}
void addProductAvx2(const ProductTask<double>& task) {
  detail::addProduct<Avx2>(task);
}
void addProductAvx2(const ProductTask<float>& task) {
  detail::addProduct<Avx2>(task);
}

}  // namespace palpa::bem
