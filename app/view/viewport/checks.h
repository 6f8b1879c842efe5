#pragma once

#include "app/view/scene/scene.h"

/// Checks of arguments. Internal to app/view.
namespace palpa::view {

/// Throws std::invalid_argument with the message unless the condition holds.
void require(bool condition, const char* message);

/// Throws unless every point has a normal and all indices name points.
void requireValidBody(const ViewportBody& body);

}  // namespace palpa::view
