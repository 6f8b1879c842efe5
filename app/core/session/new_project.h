#pragma once

#include <string>

#include "modeling/project/project.h"

namespace palpa::app {

/// An edge length (mm, two digits) that gives about 600 nodes: solved in a fraction of a second,
/// and within a few per cent of the converged answer for simple bodies.
double suitableEdgeLength(const modeling::Body& body);

/// What a new body is made of: a silicone of 0.2 MPa.
modeling::Material defaultMaterial();

/// A project around a body that can be touched at once: of the default material, held on its lowest
/// tenth, with a suitable mesh.
modeling::Project makeProject(modeling::Body body, const std::string& name);

}  // namespace palpa::app
