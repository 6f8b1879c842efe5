#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bem/contact/contact_simulation.h"

namespace palpa::bem {

/// Evaluator of the field u = base + Xi Φ f on the whole boundary for contact forces f. The
/// response to a mask, three columns, is stored while the mask stays in place, so contacts at rest
/// cost three columns each; masks that have moved are summed node by node. In single precision,
/// like the columns.
///
/// Not thread-safe, but may run concurrently with the simulation that provides the forces.
class FieldEvaluator {
 public:
  /// `base`: the field without contacts. All three arguments must outlive the evaluator.
  FieldEvaluator(const ContactSurface& surface, const GreensColumns& columns,
                 const BoundaryField& base);

  /// Evaluates the field of some patch forces; patches without columns or response are omitted.
  /// `field` has one column; its `p` is unchanged unless `withTractions`.
  void evaluate(std::span<const ContactSimulation::PatchForce> patches, bool withTractions,
                BoundaryField& field);

  /// Number of masks with a stored response.
  int keptCount() const;

 private:
  struct Kept {
    ContactMask mask;
    double asked = 0;                                  // radius
    Eigen::Matrix<float, Eigen::Dynamic, 3> response;  // Xi Φ; no rows before it is computed
    bool isUsed = false;
    bool isRough = false;  // a better response will follow
  };
  /// Stored mask of a patch; null if there is none.
  Kept* find(const ContactSimulation::PatchForce& patch);
  void addMask(const ContactSimulation::PatchForce& patch);
  void sum(Kept& kept) const;
  /// Replaces a rough response if a better one is available.
  void improve(Kept& kept) const;
  void addTraction(const ContactMask& mask, const Eigen::Vector3d& force);
  void addNodes();
  void expand(bool withTractions, BoundaryField& field) const;

  const ContactSurface& surface_;
  const GreensColumns& columns_;
  const BoundaryField& base_;
  std::unique_ptr<ContactSurface::Workspace> workspace_;
  std::vector<Kept> kept_;

  // State of one evaluation.
  Eigen::VectorXf unknowns_;
  std::vector<Eigen::Vector3d> traction_;  // per coefficient, MPa, sum of all contacts
  std::vector<int> loaded_;                // nodes whose traction_ is not zero
  std::vector<Eigen::Vector3d> direct_;    // per node: traction of masks without a stored response
  std::vector<unsigned char> isLoaded_;    // per node

  // Effect of unknown tractions at supports.
  struct Reaction {
    int dof, slot;
    Eigen::Vector3d traction;
  };
  std::vector<Reaction> reactions_;
  std::vector<int> fixedNodes_;
};

}  // namespace palpa::bem
