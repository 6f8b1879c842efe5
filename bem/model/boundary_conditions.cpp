#include "bem/model/boundary_conditions.h"

#include <algorithm>

#include "bem/model/collocation.h"

namespace palpa::bem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Sine of the angle up to which normals belong to one face: the triangles of a curved face meet at
/// such angles.
constexpr double kSameFace = 0.2;

/// Orthonormal frame whose first `constrained` columns span the directions that the supports of a
/// node fix.
std::pair<Matrix3d, int> fixedDirections(const std::vector<Vector3d>& rollerNormals, bool fixed) {
  if (fixed) return {Matrix3d::Identity(), 3};
  Matrix3d frame = Matrix3d::Zero();
  int fixedCount = 0;
  for (const Vector3d& normal : rollerNormals) {
    Vector3d rest = normal;
    for (int k = 0; k < fixedCount; ++k) rest -= frame.col(k).dot(normal) * frame.col(k);
    if (fixedCount < 3 && rest.norm() > kSameFace) frame.col(fixedCount++) = rest.normalized();
  }
  if (fixedCount == 0) return {Matrix3d::Identity(), 0};
  if (fixedCount == 1) frame.col(1) = frame.col(0).unitOrthogonal();
  if (fixedCount < 3) frame.col(2) = frame.col(0).cross(frame.col(1));
  return {frame, fixedCount};
}

}  // namespace

DegreesOfFreedom::DegreesOfFreedom(const BoundaryMesh& mesh, const TractionSlots& slots,
                                   const std::vector<SlotCondition>& conditions,
                                   const Material& material)
    : DegreesOfFreedom(slots, conditions, material, mesh.boundingSize()) {}

DegreesOfFreedom::DegreesOfFreedom(const TractionSlots& slots,
                                   const std::vector<SlotCondition>& conditions,
                                   const Material& material, double size)
    : nodes_(slots.firstOfNode.size() - 1),
      firstSlotOfNode_(slots.firstOfNode),
      conditions_(conditions),
      projectors_(slots.slots.size(), Matrix3d::Zero()),
      tractionScale_(material.youngsModulus / size) {
  for (int k = 0; k < nodeCount(); ++k) {
    std::vector<Vector3d> rollerNormals, fixedNormals;
    const auto isNewFace = [&fixedNormals](const Vector3d& normal) {
      return std::none_of(fixedNormals.begin(), fixedNormals.end(), [&](const Vector3d& other) {
        return other.dot(normal) > 0 && other.cross(normal).norm() < kSameFace;
      });
    };
    const auto fixFully = [&](int slot) {
      const Vector3d& normal = slots.slots[slot].normal;
      projectors_[slot] = Matrix3d::Identity();
      if (!isNewFace(normal)) return;
      if (!fixedNormals.empty()) extraSlots_.push_back(slot);
      fixedNormals.push_back(normal);
    };
    for (int s = slots.firstOfNode[k]; s < slots.firstOfNode[k + 1]; ++s)
      if (conditions[s] == SlotCondition::kFixed) fixFully(s);
    for (int s = slots.firstOfNode[k]; s < slots.firstOfNode[k + 1]; ++s) {
      if (conditions[s] != SlotCondition::kRoller) continue;
      const Vector3d& normal = slots.slots[s].normal;
      rollerNormals.push_back(normal);
      projectors_[s] = normal * normal.transpose();
      // The whole displacement of the node is known, so a roller on another face than the fixed one
      // needs a separate reaction, whose tangential part is unknown, too.
      if (!fixedNormals.empty() && isNewFace(normal)) fixFully(s);
    }
    std::tie(nodes_[k].frame, nodes_[k].constrained) =
        fixedDirections(rollerNormals, !fixedNormals.empty());
  }
}

std::vector<CollocationPoint> DegreesOfFreedom::collocationPoints(
    const BoundaryMesh& mesh, const TractionSlots& slots) const {
  std::vector<CollocationPoint> points = nodalCollocation(mesh);
  for (const int slot : extraSlots_) points.push_back(shiftedCollocation(mesh, slots, slot));
  return points;
}

std::vector<DegreesOfFreedom::SlotWeight> DegreesOfFreedom::tractionOf(int dof) const {
  std::vector<SlotWeight> weights;
  if (dof >= nodalCount()) {
    weights.push_back({extraSlots_[(dof - nodalCount()) / 3],
                       tractionScale_ * Vector3d::Unit((dof - nodalCount()) % 3)});
    return weights;
  }
  const int node = dof / 3;
  const Vector3d direction = tractionScale_ * nodes_[node].frame.col(dof % 3);
  for (int s = firstSlotOfNode_[node]; s < firstSlotOfNode_[node + 1]; ++s) {
    if (!isConstrained(dof))
      weights.push_back({s, direction});
    else if (conditions_[s] != SlotCondition::kTraction)
      weights.push_back({s, projectors_[s] * direction});
  }
  return weights;
}

BoundaryField DegreesOfFreedom::expand(const Eigen::MatrixXd& v,
                                       const Eigen::MatrixXd& known) const {
  const Eigen::Index states = v.cols();
  BoundaryField field{Eigen::MatrixXd::Zero(nodalCount(), states),
                      Eigen::MatrixXd::Zero(3 * slotCount(), states)};
  for (int dof = 0; dof < count(); ++dof) {
    const bool nodal = dof < nodalCount();
    const bool tractionUnknown = !nodal || isConstrained(dof);
    const bool anyKnown = nodal && known.rows() > 0;
    if (nodal && (!tractionUnknown || anyKnown)) {
      const Vector3d direction = nodes_[dof / 3].frame.col(dof % 3);
      const auto row = tractionUnknown ? known.row(dof) : v.row(dof);
      field.u.middleRows<3>(3 * (dof / 3)) += direction * row;
    }
    if (tractionUnknown || anyKnown) {
      const auto row = tractionUnknown ? v.row(dof) : known.row(dof);
      for (const SlotWeight& w : tractionOf(dof))
        field.p.middleRows<3>(3 * w.slot) += w.traction * row;
    }
  }
  return field;
}

BoundaryField DegreesOfFreedom::knownField(const BoundaryConditions& given) const {
  BoundaryField field{Eigen::VectorXd::Zero(nodalCount()), given.traction};
  for (int k = 0; k < nodeCount(); ++k) {
    const Vector3d displacement = given.displacement.segment<3>(3 * k);
    for (int d = 0; d < nodes_[k].constrained; ++d) {
      const Vector3d direction = nodes_[k].frame.col(d);
      field.u.middleRows<3>(3 * k) += direction.dot(displacement) * direction;
    }
  }
  for (int s = 0; s < slotCount(); ++s)
    field.p.middleRows<3>(3 * s) -= projectors_[s] * given.traction.segment<3>(3 * s);
  return field;
}

}  // namespace palpa::bem
