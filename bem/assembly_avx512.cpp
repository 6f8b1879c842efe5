#include "bem/assembly_loop.h"

namespace palpa::bem {

using Avx512 = xsimd::avx512f;

void assembleRowsAvx512(const AssemblyTask<double>& task) { detail::assembleRows<Avx512>(task); }
void assembleRowsAvx512(const AssemblyTask<float>& task) { detail::assembleRows<Avx512>(task); }

}  // namespace palpa::bem
