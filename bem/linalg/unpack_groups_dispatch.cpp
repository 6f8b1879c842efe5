#include "bem/base/instruction_set.h"
#include "bem/linalg/unpack_groups.h"

namespace palpa::bem {

UnpackGroups unpackGroupsForThisProcessor() {
#ifdef PALPA_X86_VARIANTS
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return unpackGroupsAvx512;
    case InstructionSet::kAvx2:
      return unpackGroupsAvx2;
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return unpackGroupsBaseline;
}

}  // namespace palpa::bem
