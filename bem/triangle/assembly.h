#pragma once

#include <vector>

#include "base/job.h"
#include "bem/base/large_matrix.h"
#include "bem/model/boundary_mesh.h"
#include "bem/model/collocation.h"
#include "bem/model/element_part.h"
#include "bem/problem/problem_inputs.h"

namespace palpa::bem {

/// Discretised boundary integral equation H u = G p with m collocation points, n displacement
/// coefficients and q traction slots. Rows: component c of point i is row c m + i. Columns:
/// component c of coefficient j is column 3 j + c. u in mm, p in MPa; H is dimensionless, G in
/// mm/MPa.
template <class Scalar>
struct BoundaryOperators {
  LargeMatrix<Scalar> H;  ///< (3m) x (3n), free term included
  LargeMatrix<Scalar> G;  ///< (3m) x (3q)
};

/// Integrates Kelvin's kernels over the mesh, all elements for all collocation points, and
/// completes H by rigid-body translation (its row sums vanish). Cost about 2e-8 s per (point,
/// triangle) on two cores. The result does not depend on the number of threads. Throws Cancelled.
template <class Scalar>
BoundaryOperators<Scalar> assemble(const BoundaryMesh& mesh, const TractionSlots& slots,
                                   const std::vector<CollocationPoint>& points,
                                   const Material& material, const AssemblyOptions& options,
                                   const Job& job);

/// Contribution of some triangles to the rows: H with columns for the coefficients of `part`, G for
/// its slots. Each row of H sums to zero for points in nodes of the part. The difference between
/// the contributions after and before these triangles moved is the change of the operators at
/// points that did not move: elsewhere on a closed surface the free term does not change.
template <class Scalar>
BoundaryOperators<Scalar> assemblePart(const BoundaryMesh& mesh, const TractionSlots& slots,
                                       const ElementPart& part,
                                       const std::vector<CollocationPoint>& points,
                                       const Material& material, const AssemblyOptions& options,
                                       const Job& job);

}  // namespace palpa::bem
