#pragma once

#include <array>
#include <vector>

#include "bem/model/boundary_mesh.h"
#include "bem/model/displacement_recovery.h"

namespace palpa::bem {

/// Weight of the bulge of each edge of each triangle (DisplacementRecovery); edge k from corner k.
using BulgeWeights = std::vector<std::array<double, 3>>;

/// Derivative of Σ weight · b by the nodes at fixed nodal values, (3, nodes); `values`: of a scalar
/// field at the nodes. The recovered slopes depend on the shape of all triangles around a slot.
Eigen::Matrix3Xd bulgeDerivative(const BoundaryMesh& mesh, const TractionSlots& slots,
                                 const DisplacementRecovery& recovery,
                                 const Eigen::VectorXd& values, const BulgeWeights& weights);

}  // namespace palpa::bem
