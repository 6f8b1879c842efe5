#pragma once

#include <optional>
#include <vector>

#include "bem/contact/contact_compliance.h"
#include "bem/contact/frictional_contact_solver.h"
#include "bem/model/material.h"

namespace palpa::bem {

/// Tool that touches the body.
struct ContactTool {
  enum class Kind {
    kGrab,  ///< prescribes all three components of the place's displacement
    kPush,  ///< a fingertip's pressure mask that presses but does not pull and slides with friction
    kBall,  ///< a rigid ball that does the same; the contact grows with depth
    kForce,  ///< a prescribed force on the place
  };
  Kind kind = Kind::kGrab;
  double radius = 6;    ///< mm; radius of the mask, for kBall of the ball
  double friction = 0;  ///< Coulomb's coefficient of tools that press, 0 … 10

  static constexpr int kBallMasks = 61;

  /// True if the tool presses but does not pull and slides with friction.
  constexpr bool presses() const {
    switch (kind) {
      case Kind::kGrab:
      case Kind::kForce:
        return false;
      case Kind::kPush:
      case Kind::kBall:
        return true;
    }
    return false;
  }
  /// Number of pressure masks that the tool may need.
  constexpr int maskCount() const {
    switch (kind) {
      case Kind::kGrab:
      case Kind::kForce:
      case Kind::kPush:
        return 1;
      case Kind::kBall:
        return kBallMasks;
    }
    return 1;
  }
  bool hasPatch() const { return maskCount() > 1; }
};

/// Simulation of any number of contacts on one body over time: grabbed places stay, pushing tools
/// slide along the surface, lift off and return. It advances in steps, up to a thousand per second.
/// Each step is a static equilibrium with friction relative to the previous step. Equal steps give
/// bitwise equal forces.
///
/// The reference of a pushing tool is the position at which it would touch without tangential
/// displacement. Its masks lie around the surface point below the reference: one mask for kPush, up
/// to ContactTool::kBallMasks on a hexagonal lattice for kBall, as dense as the mesh allows. While
/// the middle mask sticks, the reference stays and the surface follows the tool; when it slips, the
/// reference moves to the tool. Where the body bends below a ball, the ball touches beside its
/// reference: its masks follow the rotation of the surface. For friction, each mask stores the
/// displacement of its place relative to the tool at the first contact or at the last slip; a
/// sticking mask keeps this displacement.
///
/// Not thread-safe. After the first few steps with equally many contacts step() allocates no
/// memory.
class ContactSimulation {
 public:
  using Id = int;

  /// `base`: the field without contacts; `material`: at the surface. The first three arguments must
  /// outlive the simulation.
  ContactSimulation(const ContactSurface& surface, const GreensColumns& columns,
                    const BoundaryField& base, const Material& material);

  /// Begins a contact at the surface point nearest to `at` (unloaded shape, mm). `value` is the
  /// displacement of the place (mm) for kGrab, the position of the tip (mm) for kPush, the position
  /// of the ball's centre (mm) for kBall, and the force (N) for kForce.
  Id begin(const ContactTool& tool, const Eigen::Vector3d& at, const Eigen::Vector3d& value);
  /// Sets the value of an existing contact, as in begin().
  void set(Id id, const Eigen::Vector3d& value);
  /// Ends an existing contact.
  void end(Id id);
  /// Ends all contacts.
  void clear();

  /// Takes over all contacts of a simulation on another body, usually an edited version of this
  /// body, with their forces and friction state; the contacts of this simulation are discarded.
  /// Grabbed places stay at the same point of the same triangle if both meshes have the same
  /// triangles, otherwise at the nearest point; pushing tools keep their position in space. On an
  /// equal body the next step gives the same forces as `other` would give.
  void takeOver(const ContactSimulation& other);

  /// Places the masks as step() will, and returns the displacement coefficients whose columns are
  /// not available; some appear twice. Valid until the next call of another function. If none is
  /// missing, a step() that follows directly uses these places.
  const std::vector<int>& missing();
  /// Coefficients without columns at the last step().
  const std::vector<int>& missed() const { return set_.missing(); }

  /// Computes the equilibrium. `slides`: maximum number of moves of sliding tools within the step;
  /// one suffices for a rapid sequence of steps, a single step needs several.
  void step(int slides = 1);

  enum class Status : unsigned char {
    kWaiting,   ///< the columns of the place are not available yet; no force
    kFixed,     ///< a support fixes the place; no force
    kOpen,      ///< a pushing tool does not touch
    kGrabbed,   ///< a grabbed place or a given force
    kSticking,  ///< presses and does not slide
    kSlipping,  ///< presses and slides
  };
  struct PatchForce {
    SurfacePoint point{};                             ///< of the unloaded shape
    double radius = 0;                                ///< mm, of the mask
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N
  };
  struct Contact {
    Id id = -1;
    ContactTool tool;
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    Status status = Status::kWaiting;
    SurfacePoint point{};  ///< middle of the contact on the unloaded shape
    Eigen::Vector3d force = Eigen::Vector3d::Zero();         ///< N, on the body
    Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< mm, at the middle, of all causes
    /// Part of `displacement` that the force of this contact causes, mm: without loads and the
    /// forces of other contacts.
    Eigen::Vector3d deflection = Eigen::Vector3d::Zero();
    double stiffness = 0;  ///< |force| / |deflection|, N/mm; 0 if there is no force
    /// Motion of the middle along the outward normal per force on its mask in this direction, mm/N;
    /// also known while an open tool is near the surface. 0 while the columns are missing.
    double normalCompliance = 0;
    std::vector<PatchForce> patch;  ///< of the masks that carry force

    // Internal to the simulation.
    Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< mm, see the class comment
    Eigen::Vector3d across = Eigen::Vector3d::UnitX();    ///< direction of the lattice
    /// `point` and `across` of the places found by missing().
    SurfacePoint nextPoint{};
    Eigen::Vector3d nextAcross = Eigen::Vector3d::UnitX();
    /// Displacement of the middle caused by everything except this contact's force, mm.
    Eigen::Vector3d lifted = Eigen::Vector3d::Zero();
    double curvature = 0;  ///< of a ball and the surface together, 1/mm
    /// Motion of the place that a ball touches because the surface turns below it, mm.
    Eigen::Vector3d rolled = Eigen::Vector3d::Zero();
    /// Compliance of the body as a whole at the contact, mm/N: of the middle mask along the normal,
    /// minus the compliance of a half-space under the same mask. 0 before the first step.
    double farCompliance = 0;
    int firstMask = 0, maskCount = 0;
  };
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// Place of a tool with one mask that waits for columns: the response of the mask suffices
  /// (GreensColumns::computeResponse()). A tool that slides keeps this place until then.
  struct WaitingPlace {
    SurfacePoint point{};
    double radius = 0;  ///< mm, of the tool
  };
  /// Of any contact, after missing() or step().
  std::optional<WaitingPlace> waiting() const;
  /// Null if there is no such contact.
  const Contact* find(Id id) const;

  /// True if the last step satisfied all contact laws. Otherwise the forces belong to slightly soft
  /// tools (see FrictionalContactSolver; softness() returns their softness) or, if no such solution
  /// was found, to the previous step. The next step resumes the solver from its last iterate.
  bool converged() const { return forces_.converged; }
  double softness() const { return forces_.softness; }
  int maskCount() const { return set_.size(); }
  /// Condition and result of a mask (0 … maskCount() - 1) in the last step.
  struct MaskState {
    const ContactMask& mask;
    const ContactCondition& condition;  ///< kForce with zero force if the mask is unused
    ContactStatus status;
    Eigen::Vector3d force;         ///< N
    Eigen::Vector3d displacement;  ///< mm
  };
  MaskState maskState(int mask) const;
  double residual() const { return forces_.residual; }
  double reciprocityDefect() const { return set_.reciprocityDefect(); }

  /// Tractions of all contacts: one vector (MPa) for each of `nodes`, which are distinct
  /// displacement coefficients. With GreensColumns they give the field.
  void tractions(std::vector<int>& nodes, std::vector<Eigen::Vector3d>& values) const;

 private:
  void placeAll();
  void placeMasks(Contact& contact);
  SurfacePoint placeOfPush(const Contact& contact) const;
  SurfacePoint footOf(const Contact& contact) const;
  double meanCurvature(const Contact& contact, double distance) const;
  double touchedRadius(double depth, double curvature, double farCompliance) const;
  void placeBall(Contact& contact);
  double farCompliance(int mask, const Eigen::Vector3d& m) const;
  double displacementBesideDip(const Contact& contact, int mask, const Eigen::Vector3d& n) const;
  Eigen::Vector3d slopeBelow(const Contact& contact) const;
  double roll(Contact& contact) const;
  void lift(Contact& contact) const;
  double gapToBall(const Contact& contact, int mask, const Eigen::Vector3d& m) const;
  void demand(const Contact& contact);
  void read(Contact& contact);
  double slide(Contact& contact);
  Eigen::Vector3d displacementOf(int mask) const;

  const ContactSurface& surface_;
  double planeModulus_;  // E / (1 - nu^2), MPa
  ContactCompliance set_;
  FrictionalContactSolver system_;
  std::vector<Contact> contacts_;
  std::vector<ContactCondition> conditions_;  // one per mask
  /// Friction state of a mask: the sticking displacement minus the tool's position, mm.
  struct Anchor {
    Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
    bool isKnown = false;  // true if the mask was used in the last step
  };
  std::vector<Anchor> anchors_;  // one per mask
  ContactForces forces_, before_;
  Eigen::VectorXd attempt_;  // last iterate of the solver if it failed; otherwise empty
  Eigen::VectorXd displacements_;
  bool isPlaced_ = false;  // missing() has placed all masks, and nothing has changed since
  Id next_ = 0;
};

}  // namespace palpa::bem
