#pragma once

#include "app/view/viewport_scene.h"

/// Refusing what the interactive view cannot draw. Internal to app/view.
namespace palpa::view {

/// Throws std::invalid_argument with the message unless the condition holds.
void require(bool condition, const char* message);

/// Throws unless every point has a normal and all indices name points.
void requireValidBody(const ViewportBody& body);

}  // namespace palpa::view
