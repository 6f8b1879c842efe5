#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bem/contact/contact_simulation.h"

namespace palpa::bem {

/// The field on the whole boundary that belongs to the forces of contacts: u = base + Xi Φ f. What
/// a mask does to the body, three columns, is kept as long as the mask stays where it is, so that
/// the field of contacts at rest costs three columns each; masks that have moved are summed node by
/// node. In single precision, as the columns.
///
/// Not thread-safe, but may work beside the simulation that has the contacts.
class FieldEvaluator {
 public:
  /// All three must outlive it; `base`: the field without contacts.
  FieldEvaluator(const ContactSurface& surface, const GreensColumns& columns,
                 const BoundaryField& base);

  /// Patches whose columns are not there are left out. The field has one column; its `p` is left
  /// alone unless `withTractions`.
  void evaluate(std::span<const ContactSimulation::PatchForce> patches, bool withTractions,
                BoundaryField& field);

  /// Masks whose columns are summed.
  int keptCount() const;

 private:
  struct Kept {
    ContactMask mask;
    double asked = 0;                                  // radius
    Eigen::Matrix<float, Eigen::Dynamic, 3> response;  // Xi Φ; no rows before it is summed
    bool isUsed = false;
  };
  /// The mask at the place of a patch; null when it is not there yet.
  Kept* find(const ContactSimulation::PatchForce& patch);
  void addMask(const ContactSimulation::PatchForce& patch);
  void sum(Kept& kept) const;
  void addTraction(const ContactMask& mask, const Eigen::Vector3d& force);
  void addNodes();
  void expand(bool withTractions, BoundaryField& field) const;

  const ContactSurface& surface_;
  const GreensColumns& columns_;
  const BoundaryField& base_;
  std::unique_ptr<ContactSurface::Workspace> workspace_;
  std::vector<Kept> kept_;

  // Of one evaluation.
  Eigen::VectorXf unknowns_;
  std::vector<Eigen::Vector3d> traction_;  // per coefficient, MPa, of all contacts
  std::vector<int> loaded_;                // nodes whose traction_ is not zero
  std::vector<Eigen::Vector3d> direct_;    // per node: that of masks that are not kept
  std::vector<unsigned char> isLoaded_;    // per node

  // Of the supports: what unknowns that are tractions do.
  struct Reaction {
    int dof, slot;
    Eigen::Vector3d traction;
  };
  std::vector<Reaction> reactions_;
  std::vector<int> heldNodes_;
};

}  // namespace palpa::bem
