#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bem/contact/contact_mask.h"
#include "bem/linalg/capacitance_matrix.h"
#include "bem/problem/reference_problem.h"

namespace palpa::bem {

/// Several contacts with masks on one body. With Φ and Ψ the traction masks and conjugate means of
/// all contacts whose displacement is given, the compliance D = Ψ^T Xi Φ gives the forces f = D^-1
/// (d - d_free), and then the field u = u_free + Xi Φ f. Forces first: `forces()` touches only D.
class BilateralContactSolver {
 public:
  /// `base`: the field without contacts (loads and supports alone), one column.
  BilateralContactSolver(std::shared_ptr<const ReferenceProblem> problem,
                         const TractionSlots& slots, BoundaryField base);

  using Id = int;
  /// Adds a contact that grabs: its mean displacement (mm, from the unloaded shape) is given;
  /// `displacement` empty leaves it where the body without it would be. Costs one solve with three
  /// right-hand sides, unless the mask was added before. Throws SolverError (kSingular) if it
  /// coincides with another.
  Id addGrab(const ContactMask& mask, const std::optional<Eigen::Vector3d>& displacement);
  /// Adds a contact whose force (N) is given and whose displacement follows.
  Id addForce(const ContactMask& mask, const Eigen::Vector3d& force);
  void remove(Id id);

  void setDisplacement(Id id, const Eigen::Vector3d& displacement);
  void setForce(Id id, const Eigen::Vector3d& force);

  /// Solves the small system: the force (N) that each contact exerts on the body, 3 per contact in
  /// the order they were added. Does not look at the mesh: 10 contacts take microseconds.
  Eigen::VectorXd forces() const;
  /// The whole field for these forces.
  BoundaryField field(const Eigen::VectorXd& forces) const;

  struct Contact {
    Id id;
    SurfacePoint point;
    double radius;                 ///< mm, of the mask
    Eigen::Vector3d force;         ///< N, exerted by the contact on the body
    Eigen::Vector3d displacement;  ///< mm, mean over the mask
    /// Secant stiffness along the displacement that this contact causes, N/mm; 0 if it causes none.
    double stiffness;
  };
  /// The contacts in the order they were added, for these forces.
  std::vector<Contact> contacts(const Eigen::VectorXd& forces) const;

  /// Compliance of all contacts, 3 x 3 per contact, mm/N, symmetrised.
  const Eigen::MatrixXd& compliance() const { return compliance_; }
  /// Largest |D - D^T| over |D| of a contact added so far, an error indicator: zero for the exact
  /// problem.
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
  /// Indices into compliance_ of the contacts of one kind.
  std::vector<Eigen::Index> rowsOf(bool grabbed) const;

  std::shared_ptr<const ReferenceProblem> problem_;
  std::vector<int> firstSlotOfNode_;
  BoundaryField base_;
  std::vector<Entry> entries_;
  Eigen::MatrixXd compliance_;
  Eigen::VectorXd baseDisplacements_;  ///< of the contacts, without any contact force
  CapacitanceMatrix capacitance_;      ///< compliance of the grabbed contacts
  double reciprocityDefect_ = 0;
  Id nextId_ = 0;
};

}  // namespace palpa::bem
