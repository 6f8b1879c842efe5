#pragma once

namespace palpa::app {

/// Lets all other threads go first: the calling thread, and those it starts from now on, run at
/// nice 10. For threads that compute in the background of a window.
void lowerThreadPriority();

/// Lets the calling thread go first where the system allows it (it seldom does without privileges),
/// and lets it wake up in time: for a thread that has something to do every millisecond.
void raiseThreadPriority();

/// As lowerThreadPriority() for all threads of the process but the first: those that OpenBLAS
/// starts when it is loaded, at the priority of the window. For `main` to call before anything
/// else.
void lowerPriorityOfLoadedThreads();

}  // namespace palpa::app
