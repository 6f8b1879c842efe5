#pragma once

#include <string>

#include "modeling/shapes/primitive.h"

// Primitives become solids. Control points interpolate the exact shape at Greville abscissae; a
// spline profile of no higher degree is represented exactly. Edges are marked smooth where the
// shape has a tangent plane across them, and left sharp elsewhere. Deterministic; a few
// milliseconds.
namespace palpa::modeling {

/// "box", "sphere", …: the word used in messages, on the command line and in project files.
std::string shapeName(const Primitive& primitive);

/// @throws ModelingError that begins with the shape's name and says which parameter is wrong:
///         `torus: the minor radius is 9 mm; it must be smaller than …`
Solid makePrimitive(const Primitive& primitive);

struct MadeSolid {
  Solid solid;
  double deviation = 0.0;  ///< mm: largest distance of the solid's surface from the exact shape
};

/// The same, with the fit error measured by dense sampling (2 … 8 points per span and direction):
/// milliseconds to about a second, with the size of the nets.
MadeSolid makeMeasuredPrimitive(const Primitive& primitive);

}  // namespace palpa::modeling
