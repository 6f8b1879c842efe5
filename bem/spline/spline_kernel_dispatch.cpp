#include "bem/instruction_set.h"
#include "bem/spline/spline_kernel.h"

namespace palpa::bem {

SplineKernel splineKernelForThisProcessor() {
#ifdef PALPA_X86_VARIANTS
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return {placePointsAvx512, sumKernelsAvx512};
    case InstructionSet::kAvx2:
      return {placePointsAvx2, sumKernelsAvx2};
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return {placePointsBaseline, sumKernelsBaseline};
}

}  // namespace palpa::bem
