#include "bem/assembly_kernel.h"

namespace palpa::bem {
namespace {

enum class InstructionSet { kBaseline, kAvx2, kAvx512 };

InstructionSet detect() {
#ifdef PALPA_X86_VARIANTS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd"))
    return InstructionSet::kAvx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::kAvx2;
#endif
  return InstructionSet::kBaseline;
}

InstructionSet instructionSet() {
  static const InstructionSet set = detect();
  return set;
}

}  // namespace

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

const char* instructionSetName() {
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return "avx512";
    case InstructionSet::kAvx2:
      return "avx2";
    case InstructionSet::kBaseline:
      break;
  }
  return "baseline";
}

}  // namespace palpa::bem
