#include "bem/base/instruction_set.h"
#include "bem/compressed/block_products.h"

namespace palpa::bem {

AddBlockProduct addBlockProductForThisProcessor() {
#ifdef PALPA_X86_VARIANTS
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return {addBlockProductAvx512, addBlockProductAvx512};
    case InstructionSet::kAvx2:
      return {addBlockProductAvx2, addBlockProductAvx2};
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return {addBlockProductBaseline, addBlockProductBaseline};
}

}  // namespace palpa::bem
