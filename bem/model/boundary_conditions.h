#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "bem/model/boundary_mesh.h"
#include "bem/model/material.h"

namespace palpa::bem {

struct CollocationPoint;

/// Known quantity at a traction slot.
enum class SlotCondition {
  kTraction,  ///< the traction (zero where nothing is applied)
  kFixed,     ///< the displacement
  kRoller     ///< the normal displacement and the tangential traction (frictionless guide)
};

/// Data of a mixed boundary value problem. Components that the conditions do not declare known are
/// ignored.
struct BoundaryConditions {
  std::vector<SlotCondition> ofSlot;
  Eigen::VectorXd displacement;                         ///< 3 per node, mm
  Eigen::VectorXd traction;                             ///< 3 per slot, MPa
  Eigen::Vector3d bodyForce = Eigen::Vector3d::Zero();  ///< N/mm^3

  /// A body without supports or loads.
  BoundaryConditions(const BoundaryMesh& mesh, const TractionSlots& slots)
      : BoundaryConditions(mesh.nodeCount(), slots.count()) {}
  /// For any number of displacement and traction coefficients.
  BoundaryConditions(int displacements, int tractions)
      : ofSlot(tractions, SlotCondition::kTraction),
        displacement(Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(displacements))),
        traction(Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(tractions))) {}
};

/// Displacements (3 per node, mm) and tractions (3 per slot, MPa) on the whole boundary. Several
/// columns are several states.
struct BoundaryField {
  Eigen::MatrixXd u;
  Eigen::MatrixXd p;
};

/// Map from a vector of unknowns v and the conjugate known values to a boundary field.
///
/// Every node has three degrees of freedom along an orthonormal frame. A support fixes the node in
/// the first `constrained(node)` directions of the frame: there the displacement is known and v is
/// a traction that acts on the slots of the support. In the other directions the displacement is
/// unknown and the known value is a traction that acts on all slots of the node. So each degree of
/// freedom is a pair (displacement, traction) of which either is known; the capacitance method
/// exchanges the two.
///
/// Where two faces with prescribed displacement meet in a sharp edge, one traction per node is not
/// enough. Each further face gets an extra traction (the jump) and an extra collocation point
/// inside the face.
///
/// Tractions in v are divided by `tractionScale()` = E / size so that the system is well
/// conditioned.
class DegreesOfFreedom {
 public:
  DegreesOfFreedom(const BoundaryMesh& mesh, const TractionSlots& slots,
                   const std::vector<SlotCondition>& conditions, const Material& material);
  /// For any discretisation whose displacement coefficients are the slots' nodes. `size`: of the
  /// body, mm.
  DegreesOfFreedom(const TractionSlots& slots, const std::vector<SlotCondition>& conditions,
                   const Material& material, double size);

  int nodeCount() const { return static_cast<int>(nodes_.size()); }
  /// Number of unknowns and of equations: 3 per node and 3 per extra traction.
  int count() const { return 3 * (nodeCount() + static_cast<int>(extraSlots_.size())); }
  int nodalCount() const { return 3 * nodeCount(); }
  int constrained(int node) const { return nodes_[node].constrained; }
  bool isConstrained(int dof) const { return dof % 3 < nodes_[dof / 3].constrained; }
  /// Columns are the directions of the node's degrees of freedom.
  const Eigen::Matrix3d& frame(int node) const { return nodes_[node].frame; }
  bool isFree(int node) const { return nodes_[node].constrained == 0; }
  double tractionScale() const { return tractionScale_; }
  /// Takes the scale of another shape of the same body, MPa, so that both have the same unknowns.
  void setTractionScale(double scale) { tractionScale_ = scale; }
  int slotCount() const { return static_cast<int>(projectors_.size()); }
  /// Slots whose extra traction is unknown, in the order of the last unknowns.
  const std::vector<int>& extraSlots() const { return extraSlots_; }

  /// One per node, then one per extra traction.
  std::vector<CollocationPoint> collocationPoints(const BoundaryMesh& mesh,
                                                  const TractionSlots& slots) const;

  /// The field that belongs to unknowns `v` (count() rows) and known values `known` (nodalCount()
  /// rows, or no rows for zero), column by column.
  BoundaryField expand(const Eigen::MatrixXd& v, const Eigen::MatrixXd& known) const;
  /// The known part of a field with the given data: v = 0.
  BoundaryField knownField(const BoundaryConditions& conditions) const;

  /// One coefficient of the traction field that a degree of freedom drives.
  struct SlotWeight {
    int slot;
    Eigen::Vector3d traction;  ///< MPa per unit of the scaled value
  };
  /// Tractions per unit of the degree of freedom's traction, whether that is known or unknown.
  std::vector<SlotWeight> tractionOf(int dof) const;

 private:
  struct Node {
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
    int constrained = 0;
  };
  std::vector<Node> nodes_;
  std::vector<int> firstSlotOfNode_;
  std::vector<SlotCondition> conditions_;
  std::vector<Eigen::Matrix3d> projectors_;  ///< per slot: onto the directions its support fixes
  std::vector<int> extraSlots_;
  double tractionScale_;
};

/// Names of the rigid motions that the supports leave free, for messages; empty if there is none.
std::vector<std::string> freeRigidMotions(const BoundaryMesh& mesh, const DegreesOfFreedom& dofs);
/// The same for displacement coefficients at any places (mm): nodes or control points.
std::vector<std::string> freeRigidMotions(const std::vector<Eigen::Vector3d>& places, double size,
                                          const DegreesOfFreedom& dofs);

/// Throws SolverError if the supports leave a rigid motion free (kNotFixed) or the data do not
/// determine the pressure of a (nearly) incompressible body (kIncompressible): fixed everywhere at
/// nu = 0.5, or with a closed cavity above 0.47.
void checkSolvable(const BoundaryMesh& mesh, const std::vector<SlotCondition>& conditions,
                   const DegreesOfFreedom& dofs, const Material& material);
/// The same for displacement coefficients at any places; `closedSurfaces`: 1 and one per cavity.
void checkSolvable(const std::vector<Eigen::Vector3d>& places, double size, int closedSurfaces,
                   const std::vector<SlotCondition>& conditions, const DegreesOfFreedom& dofs,
                   const Material& material);

}  // namespace palpa::bem
