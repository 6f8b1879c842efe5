#include "bem/base/instruction_set.h"
#include "bem/triangle/assembly_kernel.h"

namespace palpa::bem {

template <class Scalar>
AssembleRows<Scalar> assembleRowsForThisProcessor() {
#ifdef PALPA_X86_VARIANTS
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return static_cast<AssembleRows<Scalar>>(assembleRowsAvx512);
    case InstructionSet::kAvx2:
      return static_cast<AssembleRows<Scalar>>(assembleRowsAvx2);
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return static_cast<AssembleRows<Scalar>>(assembleRowsBaseline);
}

template <class Scalar>
AddProduct<Scalar> addProductForThisProcessor() {
#ifdef PALPA_X86_VARIANTS
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return static_cast<AddProduct<Scalar>>(addProductAvx512);
    case InstructionSet::kAvx2:
      return static_cast<AddProduct<Scalar>>(addProductAvx2);
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return static_cast<AddProduct<Scalar>>(addProductBaseline);
}

template AddProduct<double> addProductForThisProcessor();
template AddProduct<float> addProductForThisProcessor();
template AssembleRows<double> assembleRowsForThisProcessor();
template AssembleRows<float> assembleRowsForThisProcessor();

}  // namespace palpa::bem
