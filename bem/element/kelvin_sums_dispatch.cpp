#include "bem/base/instruction_set.h"
#include "bem/element/kelvin_sums.h"

namespace palpa::bem {

KelvinSumLoops kelvinSumLoopsForThisProcessor() {
#ifdef PALPA_X86_VARIANTS
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      // Six or nine sums fit batches of four better than batches of eight.
      return {sumKernelsAvx512, addSumsAvx2, makeBlocksUAvx512, makeBlocksTAvx512};
    case InstructionSet::kAvx2:
      return {sumKernelsAvx2, addSumsAvx2, makeBlocksUAvx2, makeBlocksTAvx2};
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return {sumKernelsBaseline, addSumsBaseline, makeBlocksUBaseline, makeBlocksTBaseline};
}

}  // namespace palpa::bem
