#pragma once

#include <string>

#include "modeling/shapes/primitive.h"

// Conversion of primitives to solids. Control points interpolate the exact shape at Greville
// abscissae; a spline profile of no higher degree is represented exactly. Edges are marked smooth
// where the shape has a tangent plane across them, otherwise sharp. Deterministic; takes a few
// milliseconds.
namespace palpa::modeling {

/// Name of the shape in messages, on the command line and in project files: "box", "sphere", ….
std::string shapeName(const Primitive& primitive);

/// Solid of a primitive. Throws ModelingError if a parameter is invalid; the message begins with
/// the shape's name and names the parameter: `torus: the minor radius is 9 mm; it must be smaller
/// than …`.
Solid makePrimitive(const Primitive& primitive);

/// Result of makeMeasuredPrimitive().
struct MadeSolid {
  Solid solid;
  double deviation = 0.0;  ///< mm: largest distance of the solid's surface from the exact shape
};

/// Solid of a primitive with its fit error, measured by dense sampling (2 … 8 points per span and
/// direction). Takes milliseconds to about a second, depending on the size of the nets. Throws
/// ModelingError under the conditions of makePrimitive().
MadeSolid makeMeasuredPrimitive(const Primitive& primitive);

}  // namespace palpa::modeling
