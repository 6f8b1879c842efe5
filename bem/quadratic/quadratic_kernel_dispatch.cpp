#include "bem/base/instruction_set.h"
#include "bem/quadratic/quadratic_kernel.h"

namespace palpa::bem {

QuadraticKernel quadraticKernelForThisProcessor() {
#ifdef PALPA_X86_VARIANTS
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return {placeOnTriangleAvx512, triangleBasisAvx512};
    case InstructionSet::kAvx2:
      return {placeOnTriangleAvx2, triangleBasisAvx2};
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return {placeOnTriangleBaseline, triangleBasisBaseline};
}

}  // namespace palpa::bem
