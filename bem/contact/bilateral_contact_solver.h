#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bem/contact/contact_mask.h"
#include "bem/linalg/capacitance_matrix.h"
#include "bem/problem/reference_problem.h"

namespace palpa::bem {

/// Solver for several contacts with masks on one body. With Φ and Ψ the traction masks and
/// conjugate means of all contacts with prescribed displacement, the compliance D = Ψ^T Xi Φ gives
/// the forces f = D^-1 (d - d_free), and the forces give the field u = u_free + Xi Φ f. `forces()`
/// uses D alone.
class BilateralContactSolver {
 public:
  /// `base`: the field without contacts (loads and supports only), one column.
  BilateralContactSolver(std::shared_ptr<const ReferenceProblem> problem,
                         const TractionSlots& slots, BoundaryField base);

  using Id = int;
  /// Adds a contact that grabs: its mean displacement (mm, relative to the unloaded shape) is
  /// prescribed; an empty `displacement` prescribes its mean displacement without any contacts.
  /// Costs one solve with three right-hand sides. Throws SolverError (kSingular) if it coincides
  /// with another contact.
  Id addGrab(const ContactMask& mask, const std::optional<Eigen::Vector3d>& displacement);
  /// Adds a contact with prescribed force (N) and unknown displacement.
  Id addForce(const ContactMask& mask, const Eigen::Vector3d& force);
  void remove(Id id);

  /// Sets the displacement (mm) of a contact that grabs.
  void setDisplacement(Id id, const Eigen::Vector3d& displacement);
  /// Sets the force (N) of a contact with prescribed force.
  void setForce(Id id, const Eigen::Vector3d& force);

  /// Solves the small system: the force (N) of each contact on the body, 3 per contact in the order
  /// they were added. The cost does not depend on the mesh: 10 contacts take microseconds.
  Eigen::VectorXd forces() const;
  /// Whole field for the given forces (N).
  BoundaryField field(const Eigen::VectorXd& forces) const;

  struct Contact {
    Id id;
    SurfacePoint point;
    double radius;                 ///< mm, of the mask
    Eigen::Vector3d force;         ///< N, exerted by the contact on the body
    Eigen::Vector3d displacement;  ///< mm, mean over the mask
    /// Part of `displacement` that the force of this contact causes, mm.
    Eigen::Vector3d deflection;
    double stiffness;            ///< |force| / |deflection|, N/mm; 0 if there is no force
    Eigen::Matrix3d compliance;  ///< mm/N, of this contact alone
  };
  /// Contacts for the given forces, in the order they were added.
  std::vector<Contact> contacts(const Eigen::VectorXd& forces) const;

  /// Compliance of all contacts, 3 x 3 per contact, mm/N, symmetrised.
  const Eigen::MatrixXd& compliance() const { return compliance_; }
  /// Error indicator: the largest |D - D^T| over |D| of the contacts added so far; zero for the
  /// exact problem.
  double reciprocityDefect() const { return reciprocityDefect_; }

 private:
  struct Entry {
    Id id;
    ContactMask mask;
    bool grabbed;
    Eigen::Vector3d given;   ///< displacement or force
    BoundaryField response;  ///< field for unit forces along x, y, z
  };
  Id add(Entry entry);
  Eigen::Index indexOf(Id id) const;
  /// Indices into compliance_ of the grabbed contacts, or of the contacts with prescribed force.
  std::vector<Eigen::Index> rowsOf(bool grabbed) const;

  std::shared_ptr<const ReferenceProblem> problem_;
  std::vector<int> firstSlotOfNode_;
  BoundaryField base_;
  std::vector<Entry> entries_;
  Eigen::MatrixXd compliance_;
  Eigen::VectorXd baseDisplacements_;  ///< of the contacts, without contact forces
  CapacitanceMatrix capacitance_;      ///< compliance of the grabbed contacts
  double reciprocityDefect_ = 0;
  Id nextId_ = 0;
};

}  // namespace palpa::bem
