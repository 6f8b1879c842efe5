#pragma once

#include <memory>

namespace palpa::app {

/// Drops what `held` holds on a thread of low priority: giving gigabytes back to the operating
/// system takes long enough to be seen in the window. Nothing happens for null. May be called from
/// any thread. Destructors that run there must not throw.
void destroyInBackground(std::shared_ptr<const void> held);

/// Waits until everything handed over so far is gone.
void waitUntilReleased();

}  // namespace palpa::app
