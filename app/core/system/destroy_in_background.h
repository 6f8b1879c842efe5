#pragma once

#include <memory>

namespace palpa::app {

/// Releases `held` on a thread of low priority: returning gigabytes to the operating system takes
/// long enough to be seen in the window. Does nothing for null. May be called from any thread. The
/// destructors that run there must not throw.
void destroyInBackground(std::shared_ptr<const void> held);

/// Waits until everything handed over so far is destroyed.
void waitUntilDestroyed();

}  // namespace palpa::app
