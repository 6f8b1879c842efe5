#pragma once

#include <Eigen/Dense>
#include <functional>
#include <span>
#include <vector>

#include "bem/model/boundary_mesh.h"
#include "bem/model/derived_quantities.h"

namespace palpa::bem {

/// Traction (MPa) at a surface point with a unit outward normal.
using TractionFunction =
    std::function<Eigen::Vector3d(const Eigen::Vector3d& point, const Eigen::Vector3d& normal)>;

/// Load on a part of the surface.
struct SurfaceLoad {
  std::vector<int> triangles;  ///< where the function is integrated; zero elsewhere
  TractionFunction traction;
  /// Length over which the function varies, mm (the radius of a bump): integration cells are at
  /// most an eighth of it. Infinite for functions that are smooth at the size of an element.
  double featureLength;
};

/// L2 projection of the load onto the piecewise linear tractions, 3 per slot: ∫ N_s (p - t) dΓ = 0
/// for every slot. Preserves the net force and, because linear functions of position are in the
/// space of each group, the net moment. Sampling at nodes preserves neither; measured errors are 5
/// to 15 times larger.
Eigen::VectorXd projectTraction(const BoundaryMesh& mesh, const TractionSlots& slots,
                                const SurfaceLoad& load);

/// Resultant of the load function itself by quadrature, as a reference for its projection.
Resultant integrateLoad(const BoundaryMesh& mesh, const SurfaceLoad& load);

/// Calls visit(triangle, barycentric weights, quadrature weight in mm^2) for the points of a rule
/// of degree 5 on cells no larger than `cellSize`.
void visitQuadraturePoints(const BoundaryMesh& mesh, std::span<const int> triangles,
                           double cellSize,
                           const std::function<void(int, const Eigen::Vector3d&, double)>& visit);

}  // namespace palpa::bem
