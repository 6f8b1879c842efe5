#include "app/view/files/display.h"

#include <X11/Xlib.h>

#include <cstdlib>
#include <string>

#include "app/view/files/errors.h"

namespace palpa::view {

void requireDisplay() {
  if (::Display* display = XOpenDisplay(nullptr)) {
    XCloseDisplay(display);
    return;
  }
  const char* name = std::getenv("DISPLAY");
  const std::string reason =
      name && *name ? "the X display DISPLAY=" + std::string(name) + " cannot be opened"
                    : "there is no X display (DISPLAY is not set)";
  throw NoDisplayError("cannot draw: " + reason +
                       "; run the same command under a virtual one: "
                       "xvfb-run -a -s \"-screen 0 1600x1000x24\" <command>");
}

}  // namespace palpa::view
