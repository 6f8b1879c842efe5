#pragma once

namespace palpa::app {

/// Lets all other threads go first: the calling thread, and those it starts from now on, run at
/// nice 10. For threads that compute in the background of a window.
void lowerThreadPriority();

/// The same for all threads of the process but the first: those that OpenBLAS starts when it is
/// loaded, at the priority of the window. For `main` to call before anything else.
void lowerPriorityOfLoadedThreads();

}  // namespace palpa::app
