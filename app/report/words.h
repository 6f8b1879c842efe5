#pragma once

#include <string>

#include "modeling/project/project.h"

// Parts of a project in words.
namespace palpa::report {

/// "bottom, side_xmin and where (0, 0, 1) · x < -20 mm, except …".
std::string regionText(const modeling::Region& region);

/// "pressure 0.01 MPa on top".
std::string loadText(const modeling::Load& load);

/// "grab at (0, 0, 25), moved by (0, 0, -2) mm, radius 8 mm".
std::string touchText(const modeling::Touch& touch);

/// "splines", "triangles" or "quadratic", as in reports of the command line.
const char* engineName(modeling::Engine engine);

}  // namespace palpa::report
