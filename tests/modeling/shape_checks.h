#pragma once

#include <string>
#include <vector>

#include "modeling/shapes/make_primitive.h"

// Profiles and measurements for the tests of shapes, computed without the code under test.
namespace palpa::modeling::checks {

/// A polygon line of degree 1.
ProfileCurve polyline(std::vector<Eigen::Vector2d> points);

/// A cubic with uniform clamped knots.
ProfileCurve cubic(std::vector<Eigen::Vector2d> points);

/// A closed cubic, smooth at its seam (1, 0), through about the ellipse with these half axes.
ProfileCurve roundCurve(double a, double b, const Eigen::Vector2d& centre = {0, 0});

/// Largest angle (degrees) between the normals of the two sides along the smooth edges, and the
/// smallest along the sharp ones (180 without any). Ends of edges are left out by `margin`.
struct EdgeAngles {
  double largestSmooth = 0.0;
  double smallestSharp = 180.0;
};
EdgeAngles edgeAngles(const Solid& solid, double margin = 0.02);

/// Smallest angle (degrees) of the mesh with this edge length (mm).
double smallestMeshAngle(const Solid& solid, double edgeLength);

/// Message of the ModelingError that making the primitive throws; "no error" when it does not.
std::string refusal(const Primitive& primitive);

}  // namespace palpa::modeling::checks
