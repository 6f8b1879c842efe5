#include "bem/base/instruction_set.h"
#include "bem/spline/spline_kernel.h"

namespace palpa::bem {

SplineKernel splineKernelForThisProcessor() {
#ifdef PALPA_X86_VARIANTS
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return {placePointsAvx512, tabulateAvx512};
    case InstructionSet::kAvx2:
      return {placePointsAvx2, tabulateAvx2};
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return {placePointsBaseline, tabulateBaseline};
}

}  // namespace palpa::bem
