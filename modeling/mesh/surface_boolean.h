#pragma once

#include <optional>

#include "modeling/mesh/faced_triangles.h"

// Internal to modeling/mesh: union and difference by CGAL's corefinement.
namespace palpa::modeling {

/// The union of a body with a solid, or the body without the solid, both closed and oriented; its
/// triangles have no faces, see takeFaces(). None if the solid is none or cuts through itself, or
/// if the body does so near it. Deterministic.
std::optional<FacedTriangles> unionOf(const FacedTriangles& body, const FacedTriangles& solid);
std::optional<FacedTriangles> differenceOf(const FacedTriangles& body, const FacedTriangles& solid);

bool cutsThroughItself(const FacedTriangles& surface);

/// Gives every triangle the face of the nearest one of the surface that it was made from.
void takeFaces(FacedTriangles& changed, const FacedTriangles& original);

}  // namespace palpa::modeling
