#pragma once

#include <functional>

#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// Vector field on the surface: value at a point (mm) with its unit outward normal.
using SplineFunction =
    std::function<Eigen::Vector3d(const Eigen::Vector3d& point, const Eigen::Vector3d& normal)>;

/// Calls visit(place, jet, weight in mm^2) at the points of a tensor Gauss rule on the given
/// elements, each divided into cells of at most `cellSize` mm.
void visitSplinePoints(
    const SplineSurface& surface, const std::vector<int>& elements, int pointsPerDirection,
    double cellSize,
    const std::function<void(const ElementPlace&, const SurfaceJet&, double)>& visit);

/// L2 projection of tractions given on some elements (zero elsewhere) onto the traction splines: 3
/// coefficients per slot, MPa. Preserves the net force, and the net moment if the geometry of a
/// part lies in its own spline space. `featureLength`: length over which the function varies, mm;
/// infinite if the function is smooth at the size of an element. Throws SolverError (kBadMesh) if a
/// patch has no area.
Eigen::VectorXd projectTraction(const SplineSurface& surface, const SplineTractions& tractions,
                                const std::vector<int>& elements, const SplineFunction& traction,
                                double featureLength);

/// L2 projection onto the displacement splines: 3 coefficients per control point, mm. Throws
/// SolverError (kBadMesh) if a patch has no area.
Eigen::VectorXd projectDisplacement(const SplineSurface& surface, const SplineFunction& function);

}  // namespace palpa::bem
