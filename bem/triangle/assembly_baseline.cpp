#include "bem/triangle/assembly_loop.h"

namespace palpa::bem {

// The instruction set of every processor of the platform (SSE2 on x86-64).
using Baseline = xsimd::default_arch;

void assembleRowsBaseline(const AssemblyTask<double>& task) {
  detail::assembleRows<Baseline>(task);
}
void assembleRowsBaseline(const AssemblyTask<float>& task) {
  detail::assembleRows<Baseline>(task);
}
void addProductBaseline(const ProductTask<double>& task) {
  detail::addProduct<Baseline>(task);
}
void addProductBaseline(const ProductTask<float>& task) {
  detail::addProduct<Baseline>(task);
}

}  // namespace palpa::bem
