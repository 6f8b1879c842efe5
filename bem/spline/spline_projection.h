#pragma once

#include <functional>

#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// A vector at a surface point with unit outward normal.
using SplineFunction =
    std::function<Eigen::Vector3d(const Eigen::Vector3d& point, const Eigen::Vector3d& normal)>;

/// Calls visit(place, jet, weight in mm^2) for a tensor Gauss rule on every cell of at most
/// `cellSize` mm of the elements of a list.
void visitSplinePoints(
    const SplineSurface& surface, const std::vector<int>& elements, int pointsPerDirection,
    double cellSize,
    const std::function<void(const SplinePlace&, const SplineJet&, double)>& visit);

/// L2 projection of tractions given on some elements (zero elsewhere) onto the traction splines: 3
/// coefficients per slot, MPa. Keeps the net force and, where a part's geometry is in its own
/// space, the net moment. `featureLength`: mm over which the function varies, infinite when it is
/// smooth at the size of an element.
Eigen::VectorXd projectTraction(const SplineSurface& surface, const SplineTractions& tractions,
                                const std::vector<int>& elements, const SplineFunction& traction,
                                double featureLength);

/// L2 projection onto the displacement splines: 3 coefficients per control point, mm.
Eigen::VectorXd projectDisplacement(const SplineSurface& surface, const SplineFunction& function);

}  // namespace palpa::bem
