#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "modeling/shapes/spline_basis.h"
#include "modeling/solid/solid.h"

// Exact shapes, before conversion to splines: closed surfaces made of maps of the unit square.
namespace palpa::modeling {

/// Exact patch of a shape.
struct ExactPatch {
  std::string name;
  std::array<SplineBasis, 2> basis;                        ///< of the spline patch
  std::function<Eigen::Vector3d(double, double)> surface;  ///< (s, t) in [0, 1]²; ∂s × ∂t outwards
  /// By Side: true if the shape continues across this side with the same tangent plane.
  std::array<bool, 4> smooth{};
};

/// Closed surface of exact patches.
struct ExactShape {
  double smallestLength = 1.0;  ///< mm; points closer than 1e-9 of it count as equal
  std::vector<ExactPatch> patches;
};

/// Solid that interpolates every patch in its basis and joins the patches where their borders
/// coincide. Edges are marked smooth as the patches say, except edges across which a patch has
/// degree 1, because a faceted net has no tangent plane to preserve.
Solid toSolid(const ExactShape& shape);

/// Largest distance (mm) from the shape to the solid that toSolid() made of it, sampled at 2 … 8
/// points per span and direction. Each sample is the distance to the nearest point of the exact
/// surface, found by Gauss–Newton steps from the same parameters.
double largestDeviation(const ExactShape& shape, const Solid& solid);

}  // namespace palpa::modeling
