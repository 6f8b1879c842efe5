#pragma once

#include <string>
#include <vector>

#include "modeling/shapes/make_primitive.h"

// Profiles and measurements for the tests of shapes, computed without the code under test.
namespace palpa::modeling::checks {

/// Polyline of degree 1.
ProfileCurve polyline(std::vector<Eigen::Vector2d> points);

/// Cubic curve with uniform clamped knots.
ProfileCurve cubic(std::vector<Eigen::Vector2d> points);

/// Closed cubic curve, smooth at its seam (1, 0), approximately the ellipse with these half axes.
ProfileCurve roundCurve(double a, double b, const Eigen::Vector2d& centre = {0, 0});

/// Largest angle (degrees) between the normals of the two sides along the smooth edges, and the
/// smallest along the sharp ones (180 if there are none). The ends of edges are excluded by
/// `margin`.
struct EdgeAngles {
  double largestSmooth = 0.0;
  double smallestSharp = 180.0;
};
EdgeAngles edgeAngles(const Solid& solid, double margin = 0.02);

/// Smallest angle (degrees) of the mesh with the given edge length (mm).
double smallestMeshAngle(const Solid& solid, double edgeLength);

/// Message of the ModelingError thrown when making the primitive; "no error" if it does not throw.
std::string refusal(const Primitive& primitive);

}  // namespace palpa::modeling::checks
