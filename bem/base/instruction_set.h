#pragma once

namespace palpa::bem {

enum class InstructionSet { kBaseline, kAvx2, kAvx512 };

/// The widest set that this processor supports and this program was built for.
InstructionSet instructionSet();
/// Its name, for reports: "avx512", "avx2" or "baseline".
const char* instructionSetName();

}  // namespace palpa::bem
