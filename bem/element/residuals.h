#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "base/job.h"
#include "bem/element/element_quadrature.h"
#include "bem/model/boundary_conditions.h"
#include "bem/model/material.h"

namespace palpa::bem {

/// Residuals r(x) = ∫ U p - ∫ T [u(y) - u(x)] of fields at many surface points (ElementRows), mm: 3
/// rows, one column per field, for each point. Far elements are integrated only at some points of
/// each cluster of points and interpolated at the others (skeleton.h), with errors of some 1e-4 of
/// the displacement; time grows with n log n. Progress under `phase`. Throws Cancelled.
std::vector<Eigen::Matrix3Xd> residualsAt(std::span<const CollocationPlace> points,
                                          const ElementSurface& surface,
                                          const ElementQuadrature& quadrature,
                                          const Material& material, const BoundaryField& field,
                                          Phase phase, const Job& job);

}  // namespace palpa::bem
