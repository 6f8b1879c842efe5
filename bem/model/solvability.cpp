#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>

#include "base/disjoint_sets.h"
#include "bem/base/error.h"
#include "bem/model/boundary_conditions.h"

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

/// Reduced row echelon form of rigid motions: its vectors have as many zeros as possible, so that
/// messages can name single translations and rotations.
std::vector<RigidMotion> sparseBasis(Eigen::MatrixXd basis) {
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

/// Number of closed pieces of the surface.
int componentCount(const BoundaryMesh& mesh) {
  DisjointSets nodes(mesh.nodes.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    nodes.join(a, b);
    nodes.join(b, c);
  }
  return nodes.count();
}

}  // namespace

std::vector<std::string> freeRigidMotions(const BoundaryMesh& mesh, const DegreesOfFreedom& dofs) {
  return freeRigidMotions(mesh.nodes, mesh.boundingSize(), dofs);
}

std::vector<std::string> freeRigidMotions(const std::vector<Vector3d>& places, double size,
                                          const DegreesOfFreedom& dofs) {
  Vector3d center = Vector3d::Zero();
  for (const Vector3d& p : places) center += p / static_cast<double>(places.size());
  // Motion of the fixed nodes along their fixed directions relative to their whole motion, mean
  // squares: a motion is free if this ratio is small. Normals of a curved guide are off by the
  // order of (h / R)^2, so a ball in a frictionless socket shows 1e-4 here.
  constexpr double kFree = 1e-3;
  using Gram = Eigen::Matrix<double, 6, 6>;
  Gram fixed = Gram::Zero(), total = Gram::Zero();
  const auto motionAlong = [&](const Vector3d& x, const Vector3d& direction) {
    RigidMotion row;
    row << direction, (x - center).cross(direction) / size;
    return row;
  };
  for (int k = 0; k < dofs.nodeCount(); ++k)
    for (int d = 0; dofs.constrained(k) > 0 && d < 3; ++d) {
      const RigidMotion row = motionAlong(places[k], dofs.frame(k).col(d));
      total += row * row.transpose();
      if (d < dofs.constrained(k)) fixed += row * row.transpose();
    }
  if (fixed.isZero()) return {"all translations", "all rotations"};
  total += 1e-9 * total.trace() *
           Gram::Identity();  // fixed nodes on one line do not move when the body rotates about it
  const Eigen::GeneralizedSelfAdjointEigenSolver<Gram> solver(fixed, total);
  Eigen::MatrixXd freeMotions(0, 6);
  for (int k = 0; k < 6; ++k)
    if (solver.eigenvalues()[k] < kFree) {
      freeMotions.conservativeResize(freeMotions.rows() + 1, 6);
      freeMotions.row(freeMotions.rows() - 1) = solver.eigenvectors().col(k).normalized();
    }
  std::vector<std::string> names;
  for (const RigidMotion& motion : sparseBasis(freeMotions))
    names.push_back(describe(motion, center, size));
  return names;
}

void checkSolvable(const BoundaryMesh& mesh, const std::vector<SlotCondition>& conditions,
                   const DegreesOfFreedom& dofs, const Material& material) {
  checkSolvable(mesh.nodes, mesh.boundingSize(), componentCount(mesh), conditions, dofs, material);
}

void checkSolvable(const std::vector<Vector3d>& places, double size, int closedSurfaces,
                   const std::vector<SlotCondition>& conditions, const DegreesOfFreedom& dofs,
                   const Material& material) {
  const auto motions = freeRigidMotions(places, size, dofs);
  if (!motions.empty()) {
    std::string list;
    for (const auto& name : motions) list += (list.empty() ? "" : "; ") + name;
    throw SolverError(SolverError::Kind::kNotFixed,
                      "the body is not fixed: its supports leave free: " + list +
                          ". Add a fixed support, or rollers in other directions");
  }
  // The normal field on a cavity solves the homogeneous equations at nu = 0.5, so near 0.5
  // discretisation errors exceed the pressure in the cavity (a hollow sphere: 4 % at 0.3, 44 % at
  // 0.49, n = 500 to 800).
  constexpr double kCavityLimit = 0.47;
  if (material.poissonRatio > kCavityLimit && closedSurfaces > 1)
    throw SolverError(
        SolverError::Kind::kIncompressible,
        "the body has a closed cavity, and its material is nearly incompressible "
        "(Poisson's ratio above 0.47): this formulation cannot find the pressure on the "
        "cavity. Open the cavity, or use a Poisson's ratio of 0.47 or less");
  const bool heldEverywhere =
      std::none_of(conditions.begin(), conditions.end(),
                   [](SlotCondition c) { return c == SlotCondition::kTraction; });
  if (heldEverywhere && !conditions.empty() && material.poissonRatio > 0.5 - 1e-6)
    throw SolverError(SolverError::Kind::kIncompressible,
                      "the material is incompressible (Poisson's ratio 0.5) and the supports fix "
                      "the whole surface, so the pressure inside is undetermined. Leave a part of "
                      "the surface free, or use a Poisson's ratio below 0.5");
}

}  // namespace palpa::bem
