#pragma once

#include <optional>

#include "modeling/shapes/primitive.h"

// Outer size of shapes: the box around the exact shape.
namespace palpa::modeling {

/// Width (x), depth (y) and height (z) of the box around a shape, mm. Exact, except that the width
/// and depth of a loft come from samples (about 1e-4 of the size). Throws ModelingError where
/// makePrimitive() throws because of the profiles.
Eigen::Vector3d outerSize(const Primitive& primitive);

/// The shape with another outer size along one axis (0 … 2): lengths of simple shapes change as
/// their form allows (the width of a cylinder changes its depth, too), profiles are stretched from
/// x = 0 or y = 0, heights of sections from the first one. Nothing if no such shape exists, for
/// example a torus higher than half of its width.
std::optional<Primitive> withOuterSize(const Primitive& primitive, int axis, double size);

}  // namespace palpa::modeling
