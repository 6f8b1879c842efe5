#pragma once

#include "tests/render/viewport_scenes.h"

namespace palpa::render_tests {

/// Pictures of a viewport during a simulation: dented bodies with their field, contacts,
/// forces and ghost.
std::map<std::string, ViewportCase> simulateCases();

}  // namespace palpa::render_tests
