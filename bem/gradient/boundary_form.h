#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "base/job.h"
#include "bem/contact/contact_mask.h"
#include "bem/gradient/field_sampler.h"
#include "bem/model/boundary_conditions.h"

namespace palpa::bem {

/// Traction of a mask: a scalar field by a few slots and their values (1/mm^2).
struct MaskTraction {
  std::vector<int> slots;
  std::vector<double> values;
};
/// The mask's coefficients on all slots of its nodes; `firstSlot`: TractionSlots::firstOfNode.
MaskTraction maskTraction(const ContactMask& mask, const std::vector<int>& firstSlot);

/// Boundary form of the gradient by the shape (docs/theory.md, "Gradients by the shape"), prepared
/// for one surface: whatever does not depend on the fields is stored, so that two fields give the
/// derivative by all control points in one pass over the points, without a state per point.
/// Immutable; const use from several threads is safe. Memory: about 1 KiB per point of a cubic
/// element on a cubic patch.
class BoundaryForm {
 public:
  /// Motion of the points of one block by the control points: V = Σ_j N_j dP_j.
  struct Motion {
    std::vector<int> controlPoints;
    /// Three rows per point, as FieldSampler::Block::displacement, one column per control point:
    /// N_j and its derivatives along the two tangents (1/mm).
    Eigen::MatrixXd functions;
  };
  /// `motions`: one per block of the sampler, which must outlive the form.
  BoundaryForm(const FieldSampler& sampler, std::vector<Motion> motions, int controlPoints,
               const Material& material);

  /// Derivative of the energy ∫ σ(u_a):ε(u_b) dΩ of two fields (first columns) whose supports and
  /// loads move along with the material, without the change of the fields,
  ///   ∫ V · [ n σ(u_a):ε(u_b) − (∇u_a)ᵀ t(u_b) − (∇u_b)ᵀ t(u_a) ] dΓ
  /// (Eshelby's tensor), mJ/mm: one column per control point. About 0.15 µs per point of a cubic
  /// element and core; the result does not depend on the number of threads. Throws Cancelled.
  Eigen::Matrix3Xd ofEnergy(const BoundaryField& a, const BoundaryField& b,
                            const Job& job = {}) const;

  /// Adds `factor` times the derivative of the work ∫ Φ force·u dΓ of a mask by its own motion, u
  /// (three rows per coefficient) staying with the material: the centre of the mask moves along
  /// with the material and its radius stays. `traction`: of the mask; only its elements are
  /// visited. Returns the derivative by the motion of the centre.
  Eigen::Vector3d addMask(const ContactMask& mask, const MaskTraction& traction,
                          const Eigen::Vector3d& force, const Eigen::VectorXd& u, double factor,
                          Eigen::Matrix3Xd& byControlPoints) const;

 private:
  /// Points of a block whose functions are evaluated together.
  static constexpr int kLanes = 4;
  using Lanes = Eigen::Array<double, kLanes, 1>;
  struct Block {
    std::size_t first = 0;  ///< of data_
    int groups = 0;         ///< of kLanes points
  };
  class Pass;

  const FieldSampler& sampler_;
  std::vector<Motion> motions_;
  int controlPoints_;
  Material material_;
  /// Per group of points: the frame (9, by columns) and the weight, the derivatives of the
  /// displacement's functions along both tangents, the traction's functions, and N_j. Padding has
  /// weight 0.
  std::vector<Lanes> data_;
  std::vector<Block> blocks_;
  /// Blocks on which each slot is nonzero; the list of slot s begins at firstOfSlot_[s].
  std::vector<int> firstOfSlot_, blocksOfSlot_;
};

}  // namespace palpa::bem
