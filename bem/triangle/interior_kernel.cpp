#include "bem/triangle/interior_kernel.h"

#include <numbers>

#include "bem/base/instruction_set.h"
#include "bem/triangle/interior_kernel_loop.h"

namespace palpa::bem {

InteriorConstants::InteriorConstants(const Material& material) {
  constexpr double kPi = std::numbers::pi;
  const double free = 1 - material.poissonRatio;
  weightU = 1 / (16 * kPi * material.shear() * free);
  weightT = 1 / (8 * kPi * free);
  weightS = material.shear() / (4 * kPi * free);
  poissonRatio = material.poissonRatio;
}

void sumInteriorBaseline(const InteriorSumTask& task) {
  detail::sumInterior<xsimd::default_arch>(task);
}

SumInterior sumInteriorForThisProcessor() {
#ifdef PALPA_X86_VARIANTS
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return sumInteriorAvx512;
    case InstructionSet::kAvx2:
      return sumInteriorAvx2;
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return sumInteriorBaseline;
}

}  // namespace palpa::bem
