#pragma once

namespace palpa::view {

/// Throws NoDisplayError unless the X display named by the environment variable DISPLAY can be
/// opened. Debian's VTK draws through X even off screen, and aborts the process without it.
void requireDisplay();

}  // namespace palpa::view
