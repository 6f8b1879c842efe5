#include "bem/base/instruction_set.h"
#include "bem/spline/spline_kernel.h"

namespace palpa::bem {

SplineKernel splineKernelForThisProcessor() {
#ifdef PALPA_X86_VARIANTS
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      // Six or nine sums fit batches of four better than batches of eight.
      return {placePointsAvx512, tabulateAvx512,    sumKernelsAvx512,
              addSumsAvx2,       makeBlocksUAvx512, makeBlocksTAvx512};
    case InstructionSet::kAvx2:
      return {placePointsAvx2, tabulateAvx2,    sumKernelsAvx2,
              addSumsAvx2,     makeBlocksUAvx2, makeBlocksTAvx2};
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return {placePointsBaseline, tabulateBaseline,    sumKernelsBaseline,
          addSumsBaseline,     makeBlocksUBaseline, makeBlocksTBaseline};
}

}  // namespace palpa::bem
