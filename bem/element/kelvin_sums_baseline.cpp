#include "bem/element/kelvin_sums_loop.h"

namespace palpa::bem {

void sumKernelsBaseline(const SumKernelsTask& task) {
  detail::sumKernels<xsimd::default_arch>(task);
}
void addSumsBaseline(const AddSumsTask& task) {
  detail::addSums<xsimd::default_arch>(task);
}
void makeBlocksUBaseline(const MakeBlocksTask& task) {
  detail::makeBlocks<xsimd::default_arch, detail::BlockU>(task);
}
void makeBlocksTBaseline(const MakeBlocksTask& task) {
  detail::makeBlocks<xsimd::default_arch, detail::BlockT>(task);
}

}  // namespace palpa::bem
