#include "bem/model/traction_projection.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

#include "bem/base/triangle_rule.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

/// Mass matrix of the linear basis, one row per slot: ∫ N_a N_b = area (1 + delta_ab) / 12 per
/// triangle.
Eigen::SparseMatrix<double> massMatrix(const BoundaryMesh& mesh, const TractionSlots& slots) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(mesh.triangles.size() * 9);
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    const double unit = mesh.area(t) / 12.0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        entries.emplace_back(slots.ofCorner[t][a], slots.ofCorner[t][b], a == b ? 2 * unit : unit);
  }
  Eigen::SparseMatrix<double> mass(slots.count(), slots.count());
  mass.setFromTriplets(entries.begin(), entries.end());
  return mass;
}

double cellSizeOf(const SurfaceLoad& load) {
  return load.featureLength / 8;
}

}  // namespace

void visitQuadraturePoints(const BoundaryMesh& mesh, std::span<const int> triangles,
                           double cellSize,
                           const std::function<void(int, const Vector3d&, double)>& visit) {
  for (const int t : triangles) {
    const auto& c = mesh.triangles[t];
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (mesh.nodes[c[(k + 1) % 3]] - mesh.nodes[c[k]]).norm());
    // The triangle is cut into cells^2 congruent cells; the limit bounds the time for tiny feature
    // lengths.
    const int cells = static_cast<int>(std::clamp(std::ceil(longest / cellSize), 1.0, 64.0));
    const double weight = mesh.area(t) / (cells * cells);
    const auto visitCell = [&](double i, double j, double sign) {
      for (const TrianglePoint& q : triangleRule7()) {
        const double u = (i + sign * q.barycentric[1]) / cells;
        const double v = (j + sign * q.barycentric[2]) / cells;
        visit(t, Vector3d(1 - u - v, u, v), weight * q.weight);
      }
    };
    for (int i = 0; i < cells; ++i)
      for (int j = 0; i + j < cells; ++j) {
        visitCell(i, j, 1);
        if (i + j + 1 < cells) visitCell(i + 1, j + 1, -1);
      }
  }
}

Eigen::VectorXd projectTraction(const BoundaryMesh& mesh, const TractionSlots& slots,
                                const SurfaceLoad& load) {
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(slots.count(), 3);
  visitQuadraturePoints(
      mesh, load.triangles, cellSizeOf(load), [&](int t, const Vector3d& weights, double area) {
        const Vector3d value = area * load.traction(mesh.point(t, weights), mesh.normal(t));
        if (value.isZero(0)) return;
        for (int a = 0; a < 3; ++a)
          right.row(slots.ofCorner[t][a]) += weights[a] * value.transpose();
      });
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(massMatrix(mesh, slots));
  const Eigen::MatrixXd solution = factors.solve(right);
  Eigen::VectorXd traction(3 * slots.count());
  for (int s = 0; s < slots.count(); ++s) traction.segment<3>(3 * s) = solution.row(s).transpose();
  return traction;
}

Resultant integrateLoad(const BoundaryMesh& mesh, const SurfaceLoad& load) {
  Resultant sum;
  visitQuadraturePoints(mesh, load.triangles, cellSizeOf(load),
                        [&](int t, const Vector3d& weights, double area) {
                          const Vector3d point = mesh.point(t, weights);
                          const Vector3d force = area * load.traction(point, mesh.normal(t));
                          sum.force += force;
                          sum.moment += point.cross(force);
                        });
  return sum;
}

}  // namespace palpa::bem
