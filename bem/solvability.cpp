#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>

#include "bem/boundary_conditions.h"
#include "bem/error.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using RigidMotion = Eigen::Matrix<double, 6, 1>;  // translation, rotation times size

std::string formatVector(const Vector3d& v) {
  char text[96];
  // Adding zero turns -0 into 0.
  std::snprintf(text, sizeof text, "(%.3g, %.3g, %.3g)", v[0] + 0.0, v[1] + 0.0, v[2] + 0.0);
  return text;
}

std::string axisName(const Vector3d& direction) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(direction[k]) > 0.9999) return std::string(1, "xyz"[k]);
  return formatVector(direction);
}

std::string describe(const RigidMotion& motion, const Vector3d& center, double size) {
  const Vector3d translation = motion.head<3>();
  const Vector3d rotation = motion.tail<3>() / size;
  if (rotation.norm() * size < 1e-6 * translation.norm())
    return "translation along " + axisName(translation.normalized());
  // u(x) = t + w × (x - center): the axis passes where the motion is parallel to w.
  const Vector3d point = center + rotation.cross(translation) / rotation.squaredNorm();
  Vector3d shown = point;
  for (int k = 0; k < 3; ++k)
    if (std::abs(shown[k]) < 1e-6 * size) shown[k] = 0;
  return "rotation about the axis along " + axisName(rotation.normalized()) + " through " +
         formatVector(shown) + " mm";
}

/// Null space of a symmetric positive semidefinite matrix in reduced row echelon form, whose
/// vectors have as many zeros as possible and so read as single translations and rotations.
std::vector<RigidMotion> sparseNullSpace(const Eigen::Matrix<double, 6, 6>& gram) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(gram);
  const double largest = solver.eigenvalues()[5];
  Eigen::MatrixXd basis(0, 6);
  for (int k = 0; k < 6; ++k)
    if (solver.eigenvalues()[k] <= 1e-8 * largest) {
      basis.conservativeResize(basis.rows() + 1, 6);
      basis.row(basis.rows() - 1) = solver.eigenvectors().col(k).transpose();
    }
  Eigen::Index rank = 0;
  // Rotations are eliminated first, so that the last vectors are pure translations.
  for (const int column : {5, 4, 3, 2, 1, 0}) {
    if (rank == basis.rows()) break;
    Eigen::Index pivot = 0;
    const double size = basis.col(column).tail(basis.rows() - rank).cwiseAbs().maxCoeff(&pivot);
    if (size < 1e-4) continue;
    basis.row(rank).swap(basis.row(rank + pivot));
    basis.row(rank) /= basis(rank, column);
    for (Eigen::Index r = 0; r < basis.rows(); ++r)
      if (r != rank) basis.row(r) -= basis(r, column) * basis.row(rank);
    ++rank;
  }
  std::vector<RigidMotion> motions;
  for (Eigen::Index r = basis.rows() - 1; r >= 0; --r)
    motions.emplace_back(basis.row(r).transpose());
  return motions;
}

}  // namespace

std::vector<std::string> freeRigidMotions(const BoundaryMesh& mesh, const DegreesOfFreedom& dofs) {
  const double size = mesh.boundingSize();
  Vector3d center = Vector3d::Zero();
  for (const Vector3d& p : mesh.nodes) center += p / mesh.nodeCount();
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  for (int k = 0; k < mesh.nodeCount(); ++k)
    for (int d = 0; d < dofs.constrained(k); ++d) {
      const Vector3d direction = dofs.frame(k).col(d);
      RigidMotion row;
      row << direction, (mesh.nodes[k] - center).cross(direction) / size;
      gram += row * row.transpose();
    }
  std::vector<std::string> names;
  if (gram.isZero()) return {"all translations", "all rotations"};
  for (const RigidMotion& motion : sparseNullSpace(gram))
    names.push_back(describe(motion, center, size));
  return names;
}

void checkSolvable(const BoundaryMesh& mesh, const TractionSlots& slots,
                   const std::vector<SlotCondition>& conditions, const DegreesOfFreedom& dofs,
                   const Material& material) {
  const auto motions = freeRigidMotions(mesh, dofs);
  if (!motions.empty()) {
    std::string list;
    for (const auto& name : motions) list += (list.empty() ? "" : "; ") + name;
    throw SolverError(SolverError::Kind::kNotHeld,
                      "the body is not held: its supports leave free: " + list +
                          ". Add a fixed support, or rollers in other directions");
  }
  const bool heldEverywhere =
      std::none_of(conditions.begin(), conditions.end(),
                   [](SlotCondition c) { return c == SlotCondition::kTraction; });
  if (heldEverywhere && slots.count() > 0 && material.poissonRatio > 0.5 - 1e-6)
    throw SolverError(SolverError::Kind::kIncompressible,
                      "the material is incompressible (Poisson's ratio 0.5) and the supports hold "
                      "the whole surface, so the pressure inside is undetermined. Leave a part of "
                      "the surface free, or use a Poisson's ratio below 0.5");
}

}  // namespace palpa::bem
