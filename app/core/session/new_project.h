#pragma once

#include <string>

#include "modeling/project/project.h"

namespace palpa::app {

/// An edge length (mm, two digits) that gives about 600 nodes, 300 for mesh bodies: the model is
/// built in a fraction of a second, and its results are within a few per cent of converged ones for
/// simple bodies.
double suitableEdgeLength(const modeling::Body& body);

/// Material of a new body: a silicone of 0.2 MPa.
modeling::Material defaultMaterial();

/// A project with a body that can be touched at once: default material, its lowest tenth fixed, a
/// suitable mesh.
modeling::Project makeProject(modeling::Body body, const std::string& name);

/// A project with the solid of a primitive: default material, its flat base or, if it is round, its
/// lowest tenth fixed, a suitable mesh. `solid`: made from the primitive.
modeling::Project makeProject(const modeling::Primitive& primitive, modeling::Solid solid,
                              const std::string& name);

}  // namespace palpa::app
