#include "bench/plain_assembly.h"

#include <algorithm>

#include "base/parallel.h"
#include "bem/base/triangle_rule.h"
#include "bem/triangle/kelvin.h"

namespace palpa::bench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr bem::TrianglePoint kRule3[3] = {{{2.0 / 3, 1.0 / 6, 1.0 / 6}, 1.0 / 3},
                                          {{1.0 / 6, 2.0 / 3, 1.0 / 6}, 1.0 / 3},
                                          {{1.0 / 6, 1.0 / 6, 2.0 / 3}, 1.0 / 3}};

struct Element {
  Matrix3d corners;  ///< columns
  Vector3d normal;
  double area;
};

struct Blocks {
  Matrix3d T[3], U[3];
};

/// Adds the integrals over the part of an element whose corners have the barycentric coordinates
/// `cell`.
void integrate(const Element& element, const Matrix3d& cell, double part, const Vector3d& x,
               const bem::Material& material, const PlainAccuracy& accuracy, int depth,
               Blocks& sum) {
  constexpr int kDeepest = 7;
  const Matrix3d corners = element.corners * cell;
  const Vector3d centroid = corners.rowwise().mean();
  const double radius = (corners.colwise() - centroid).colwise().norm().maxCoeff();
  const double ratio = (centroid - x).norm() / radius;
  if (ratio < accuracy.near && depth < kDeepest) {
    const Vector3d m0 = (cell.col(0) + cell.col(1)) / 2, m1 = (cell.col(1) + cell.col(2)) / 2,
                   m2 = (cell.col(2) + cell.col(0)) / 2;
    Matrix3d sub[4];
    sub[0] << cell.col(0), m0, m2;
    sub[1] << m0, cell.col(1), m1;
    sub[2] << m2, m1, cell.col(2);
    sub[3] << m0, m1, m2;
    for (const Matrix3d& s : sub)
      integrate(element, s, part / 4, x, material, accuracy, depth + 1, sum);
    return;
  }
  for (const auto& q : ratio > accuracy.far ? accuracy.coarse : accuracy.fine) {
    const Vector3d weights = cell * Vector3d(q.barycentric[0], q.barycentric[1], q.barycentric[2]);
    const Vector3d y = element.corners * weights;
    const Matrix3d T = kelvinTraction(x, y, element.normal, material);
    const Matrix3d U = kelvinDisplacement(x, y, material);
    for (int a = 0; a < 3; ++a) {
      const double factor = q.weight * part * element.area * weights[a];
      sum.T[a] += factor * T;
      sum.U[a] += factor * U;
    }
  }
}

}  // namespace

PlainAccuracy looseAccuracy() {
  return {8, 3, kRule3, bem::triangleRule7()};
}

PlainAccuracy sameAccuracy() {
  return {18.8, 5.1, bem::triangleRule7(), bem::triangleRule16()};
}

void assemblePlain(const bem::BoundaryMesh& mesh, const bem::TractionSlots& slots,
                   const std::vector<Vector3d>& points, const bem::Material& material,
                   const PlainAccuracy& accuracy, Eigen::MatrixXd& H, Eigen::MatrixXd& G,
                   const Job& job) {
  H = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(points.size()), 3 * mesh.nodeCount());
  G = Eigen::MatrixXd::Zero(H.rows(), 3 * slots.count());
  parallelFor(static_cast<std::ptrdiff_t>(points.size()), job, [&](std::ptrdiff_t k) {
    for (int t = 0; t < mesh.triangleCount(); ++t) {
      Element element{{}, mesh.normal(t), mesh.area(t)};
      for (int a = 0; a < 3; ++a) element.corners.col(a) = mesh.nodes[mesh.triangles[t][a]];
      Blocks sum;
      for (int a = 0; a < 3; ++a) sum.T[a] = sum.U[a] = Matrix3d::Zero();
      integrate(element, Matrix3d::Identity(), 1.0, points[k], material, accuracy, 0, sum);
      for (int a = 0; a < 3; ++a) {
        H.block<3, 3>(3 * k, 3 * mesh.triangles[t][a]) += sum.T[a];
        G.block<3, 3>(3 * k, 3 * slots.ofCorner[t][a]) += sum.U[a];
      }
    }
  });
}

}  // namespace palpa::bench
