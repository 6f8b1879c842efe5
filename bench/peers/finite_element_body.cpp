#include "bench/peers/finite_element_body.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace palpa::bench {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

std::vector<int> allFaces(const TetrahedralMesh& mesh) {
  std::vector<int> faces(mesh.faces.size());
  std::iota(faces.begin(), faces.end(), 0);
  return faces;
}

}  // namespace

VectorXd FiniteElementBody::solve(const Displacement& displacement, const Traction& traction) {
  VectorXd forces = VectorXd::Zero(unknowns()), held = VectorXd::Zero(3 * elements_.fixedCount);
  for (int k = 0; k < mesh_.nodeCount(); ++k)
    if (const int at = elements_.fixedOfNode[k]; at >= 0)
      held.segment<3>(3 * at) = displacement(mesh_.nodes[k]);
  std::vector<int> faces = allFaces(mesh_);
  std::erase_if(faces, [&](int face) { return mesh_.tags[face] != 0; });
  visitFaces(
      mesh_, faces, 1,
      [&](int face, const FaceFunctions& functions, const Vector3d& x, const Vector3d& area) {
        const Vector3d force = traction(x, area.normalized()) * area.norm();
        for (int k = 0; k < mesh_.faceNodes(); ++k)
          if (const int at = elements_.freeOfNode[mesh_.faces[face][k]]; at >= 0)
            forces.segment<3>(3 * at) += functions.value[k] * force;
      });
  const VectorXd free = cholesky_.solve(forces - elements_.coupling * held);
  VectorXd u(3 * mesh_.nodeCount());
  for (int k = 0; k < mesh_.nodeCount(); ++k) {
    if (const int at = elements_.freeOfNode[k]; at >= 0)
      u.segment<3>(3 * k) = free.segment<3>(3 * at);
    else
      u.segment<3>(3 * k) = held.segment<3>(3 * elements_.fixedOfNode[k]);
  }
  return u;
}

FiniteElementBody::Touch FiniteElementBody::touch(const SurfaceMask& mask) {
  MatrixXd forces = MatrixXd::Zero(unknowns(), 3);
  for (std::size_t k = 0; k < mask.nodes.size(); ++k)
    if (const int at = elements_.freeOfNode[mask.nodes[k]]; at >= 0)
      for (int c = 0; c < 3; ++c) forces(3 * at + c, c) = mask.weights[k];
  Touch touch;
  touch.half = cholesky_.solveForward(forces);
  touch.compliance = touch.half.transpose() * touch.half;
  return touch;
}

VectorXd FiniteElementBody::field(const Touch& touch, const Vector3d& force) {
  return cholesky_.solveBackward(touch.half * force);
}

MatrixXd FiniteElementBody::condensedCompliance(const std::vector<int>& nodes) {
  constexpr Eigen::Index kBlock = 96;  // right-hand sides, as bem::GreensColumns takes
  const auto size = 3 * static_cast<Eigen::Index>(nodes.size());
  MatrixXd compliance(size, size);
  const auto dof = [&](Eigen::Index k) {
    return 3 * elements_.freeOfNode[nodes[k / 3]] + static_cast<int>(k % 3);
  };
  for (Eigen::Index first = 0; first < size; first += kBlock) {
    const Eigen::Index count = std::min(kBlock, size - first);
    MatrixXd forces = MatrixXd::Zero(unknowns(), count);
    for (Eigen::Index k = 0; k < count; ++k) forces(dof(first + k), k) = 1;
    const MatrixXd u = cholesky_.solve(forces);
    for (Eigen::Index row = 0; row < size; ++row)
      compliance.row(row).segment(first, count) = u.row(dof(row));
  }
  return compliance;
}

double surfaceError(const TetrahedralMesh& mesh, const VectorXd& u,
                    const FiniteElementBody::Displacement& exact) {
  double error = 0, scale = 0;
  visitFaces(
      mesh, allFaces(mesh), 1,
      [&](int face, const FaceFunctions& functions, const Vector3d& x, const Vector3d& area) {
        Vector3d found = Vector3d::Zero();
        for (int k = 0; k < mesh.faceNodes(); ++k)
          found += functions.value[k] * u.segment<3>(3 * mesh.faces[face][k]);
        const Vector3d wanted = exact(x);
        error += area.norm() * (found - wanted).squaredNorm();
        scale += area.norm() * wanted.squaredNorm();
      });
  return std::sqrt(error / scale);
}

}  // namespace palpa::bench
