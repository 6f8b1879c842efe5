#pragma once

#include <vector>

#include "base/job.h"
#include "bem/model/body_force.h"
#include "bem/model/collocation.h"
#include "bem/triangle/flat_triangle.h"

namespace palpa::bem {

/// Term of a uniform body force in the boundary integral equation of flat triangles. Needs
///   I = ∫ r / R dΓ
/// of each triangle: in closed form from the edges near the point (the integrals of 1/R and ρ/R in
/// Wilton et al. 1984), by rules of degree 8 and 5 farther away, to 1e-8 of the triangle's area.
/// Holds tables of the mesh, about 250 bytes per triangle; keep it for many points. Const use from
/// several threads is safe.
class TriangleBodyForce {
 public:
  explicit TriangleBodyForce(const BoundaryMesh& mesh);

  /// B(x), mm, at a point inside or on the surface. About 30 ns per triangle.
  Eigen::Vector3d at(const Eigen::Vector3d& x, const Bulk& bulk) const;
  /// B at collocation points: component c of point i in row c m + i. Throws Cancelled.
  Eigen::VectorXd term(const std::vector<CollocationPoint>& points, const Bulk& bulk,
                       const Job& job) const;

 private:
  std::vector<FlatTriangle> shapes_;
  std::vector<double> corners_;  ///< 9 per triangle
};

/// I of one triangle in closed form.
Eigen::Vector3d directionIntegral(const FlatTriangle& triangle, const Eigen::Vector3d& x);

/// Volume moments of the polyhedron, exact.
VolumeMoments volumeMoments(const BoundaryMesh& mesh);

/// Work of a uniform body force, with u between the nodes from `DisplacementRecovery`.
BodyForceWork bodyForceWork(const BoundaryMesh& mesh, const TractionSlots& slots, const Bulk& bulk);

}  // namespace palpa::bem
