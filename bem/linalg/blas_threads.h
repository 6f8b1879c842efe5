#pragma once

namespace palpa::bem {

/// Makes OpenBLAS use one thread, for the whole process. Its threads wait for each other in busy
/// loops: with another program on one of two cores they took ten times as long as one thread.
void useOneBlasThread();

}  // namespace palpa::bem
