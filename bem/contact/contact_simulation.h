#pragma once

#include <vector>

#include "bem/contact/contact_compliance.h"
#include "bem/contact/frictional_contact_solver.h"

namespace palpa::bem {

/// What touches the body, and how.
struct ContactTool {
  enum class Kind {
    kGrab,   ///< holds the place: all three components of its displacement follow the hand
    kPush,   ///< a fingertip's pressure mask that presses but does not pull; it slides, with
             ///< friction
    kProbe,  ///< a rigid ball that presses but does not pull; the contact grows with depth
    kForce,  ///< a given force on the place
  };
  Kind kind = Kind::kGrab;
  double radius = 6;    ///< mm; of the mask, for kProbe of the ball
  double friction = 0;  ///< Coulomb's coefficient of kPush and kProbe, 0 … 10

  bool isPushing() const { return kind == Kind::kPush || kind == Kind::kProbe; }
};

/// Any number of contacts on one body over time: grabbed places stay, pushing tools slide along the
/// surface, let go and come back. Advanced in steps, a thousand a second; each step is a static
/// equilibrium, and friction remembers the step before. The same steps give the same forces, bit
/// for bit.
///
/// A pushing tool knows the place in which it would touch without tangential displacement, its
/// reference. Its masks sit around the surface point below the reference: one under kPush, up to
/// kProbeMasks on a hexagonal lattice under kProbe, as close as the mesh can carry them. While the
/// middle one sticks, the reference stays and the surface is dragged along; when it slips, the
/// reference is where the tool has come to. Friction remembers for every mask by how much its place
/// was displaced, as seen from the tool, when it was met or last slipped: that is what sticks.
///
/// Not thread-safe. After the first few steps with as many contacts step() allocates nothing.
class ContactSimulation {
 public:
  using Id = int;
  static constexpr int kProbeMasks = 61;

  /// All three must outlive the simulation; `base`: the field without contacts.
  ContactSimulation(const ContactSurface& surface, const GreensColumns& columns,
                    const BoundaryField& base);

  /// Begins a contact at the surface point nearest to `at` (unloaded shape, mm). Its value is, for
  /// kGrab, the displacement of the place (mm); for kPush the position of the tip and for kProbe
  /// that of the ball's centre (mm, in space); for kForce the force (N).
  Id begin(const ContactTool& tool, const Eigen::Vector3d& at, const Eigen::Vector3d& value);
  void set(Id id, const Eigen::Vector3d& value);
  void end(Id id);
  void clear();

  /// Takes over all contacts of a simulation on another body, usually an edited version of this
  /// one, with their forces and what friction remembers; whatever this one held is forgotten.
  /// Grabbed places stay at the same point of the same triangle when both meshes have the same
  /// triangles, at the nearest point otherwise; pushing tools stay where they are in space. On an
  /// equal body the next step gives the forces that the other would have given.
  void takeOver(const ContactSimulation& other);

  /// Places the masks as step() will and returns the coefficients whose columns it would miss, some
  /// of them twice. Valid until the next call of anything else.
  const std::vector<int>& missing();
  /// The same of the last step().
  const std::vector<int>& missed() const { return set_.missing(); }

  /// Finds the equilibrium. `slides`: how often at most sliding tools may take another place within
  /// the step; one is enough when steps follow each other quickly, several for a step on its own.
  void step(int slides = 1);

  enum class Status : unsigned char {
    kWaiting,   ///< the columns of the place are not there yet; no force
    kHeld,      ///< a support holds the place; no force
    kOpen,      ///< a pushing tool does not touch
    kHolding,   ///< a grabbed place or a given force
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
    Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< mm, at the middle
    /// Secant stiffness along the displacement that all contacts cause there, N/mm; 0 if none.
    double stiffness = 0;
    std::vector<PatchForce> patch;  ///< of the masks that carry force

    // Of the simulation alone.
    Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< mm, see above
    Eigen::Vector3d across = Eigen::Vector3d::UnitX();    ///< direction of the lattice
    /// mm, of the middle, by all else than this contact's own force
    Eigen::Vector3d lifted = Eigen::Vector3d::Zero();
    int firstMask = 0, maskCount = 0;
  };
  const std::vector<Contact>& contacts() const { return contacts_; }
  const Contact* find(Id id) const;

  /// Did the last step meet all laws? When not, they are those of tools that are a little soft
  /// (FrictionalContactSolver; softness() says by how much), or, when also these were not found,
  /// those of the step before; the next step goes on from where the solver was.
  bool converged() const { return forces_.converged; }
  double softness() const { return forces_.softness; }
  int maskCount() const { return set_.size(); }
  /// What the laws demanded of a mask (0 … maskCount() - 1) in the last step, and what came of it.
  struct MaskState {
    const ContactMask& mask;
    const ContactCondition& condition;  ///< kForce of nothing when the mask is not used
    ContactStatus status;
    Eigen::Vector3d force;         ///< N
    Eigen::Vector3d displacement;  ///< mm
  };
  MaskState maskState(int mask) const;
  double residual() const { return forces_.residual; }
  double reciprocityDefect() const { return set_.reciprocityDefect(); }

  /// The tractions of all contacts: 3 numbers (MPa) for each of `nodes`, displacement coefficients
  /// that appear once. With GreensColumns they give the field.
  void tractions(std::vector<int>& nodes, std::vector<Eigen::Vector3d>& values) const;

 private:
  void placeAll();
  void placeMasks(Contact& contact);
  SurfacePoint footOf(const Contact& contact) const;
  double meanCurvature(const Contact& contact, double distance) const;
  void placeProbe(Contact& contact);
  void lift(Contact& contact) const;
  double gapToBall(const Contact& contact, int mask, const Eigen::Vector3d& m) const;
  void demand(const Contact& contact);
  void read(Contact& contact);
  double slide(Contact& contact);
  Eigen::Vector3d displacementOf(int mask) const;

  const ContactSurface& surface_;
  ContactCompliance set_;
  FrictionalContactSolver system_;
  std::vector<Contact> contacts_;
  std::vector<ContactCondition> conditions_;  // one per mask
  /// What friction remembers of a mask: the displacement that sticks, less the tool's position, mm.
  struct Anchor {
    Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
    bool isKnown = false;  // was the mask in use in the last step?
  };
  std::vector<Anchor> anchors_;  // one per mask
  ContactForces forces_, before_;
  Eigen::VectorXd attempt_;  // where the solver was when it found nothing; otherwise empty
  Eigen::VectorXd displacements_;
  Id next_ = 0;
};

}  // namespace palpa::bem
