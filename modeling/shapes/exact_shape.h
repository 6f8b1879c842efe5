#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "modeling/shapes/spline_basis.h"
#include "modeling/solid/solid.h"

// A shape before it becomes splines: a closed surface made of maps of the unit square.
namespace palpa::modeling {

struct ExactPatch {
  std::string name;
  std::array<SplineBasis, 2> basis;                        ///< of the patch that will represent it
  std::function<Eigen::Vector3d(double, double)> surface;  ///< (s, t) in [0, 1]²; ∂s × ∂t outwards
  /// By Side: does the shape continue over this side with the same tangent plane?
  std::array<bool, 4> smooth{};
};

struct ExactShape {
  double smallestLength = 1.0;  ///< mm; points closer than 1e-9 of it are the same
  std::vector<ExactPatch> patches;
};

/// Interpolates every patch in its basis and joins the patches where their borders coincide. Edges
/// are marked smooth as the patches say, but none of a patch of degree 1 across it: a faceted net
/// has no tangent plane to keep.
Solid toSolid(const ExactShape& shape);

/// Largest distance (mm) of the solid that toSolid() made from the shape: at 2 … 8 points per span
/// and direction, the distance to the nearest point of the exact surface found by Gauss–Newton
/// steps from the same parameters.
double largestDeviation(const ExactShape& shape, const Solid& solid);

}  // namespace palpa::modeling
