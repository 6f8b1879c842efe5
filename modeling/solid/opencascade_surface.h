#pragma once

#include <Geom_BSplineSurface.hxx>
#include <vector>

#include "modeling/solid/solid.h"

// Patches as OpenCASCADE surfaces, for the files of modeling/ that use its spline algebra. No
// public header includes this one.
namespace palpa::modeling {

/// Distinct values of a non-decreasing list.
std::vector<double> distinct(const std::vector<double>& knots);

/// OpenCASCADE surface of a patch that passes checkPatches() with its control points. Throws
/// Standard_Failure if OpenCASCADE rejects it.
Handle(Geom_BSplineSurface)
    makeSurface(const std::vector<Eigen::Vector3d>& points, const Patch& patch);

/// Poles of a surface: result[i][j], i along u and j along v.
std::vector<std::vector<Eigen::Vector3d>> polesOf(const Geom_BSplineSurface& surface);

}  // namespace palpa::modeling
