#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

namespace palpa::bem {

/// Condition of one contact, with f its force on the body (N) and d its displacement (mm).
struct ContactCondition {
  enum class Kind {
    kGrab,        ///< d = value
    kForce,       ///< f = value
    kUnilateral,  ///< laws of Signorini and Coulomb, see `normal`
  };
  Kind kind = Kind::kGrab;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  /// kUnilateral: unit vector along which the contact can press, into the body. With λ = f · normal
  /// and the gap g = (d - value) · normal: λ >= 0, g >= 0, λ g = 0. The tangential force f_t and
  /// the slip w = (d - value)_t satisfy |f_t| <= friction λ; w = 0 below this bound, otherwise f_t
  /// is opposite to w.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double friction = 0;  ///< Coulomb's coefficient, >= 0
};

enum class ContactStatus : unsigned char { kGrabbed, kForced, kOpen, kSticking, kSlipping };

struct ContactForces {
  Eigen::VectorXd forces;               ///< 3 per contact, N
  std::vector<ContactStatus> statuses;  ///< one per contact
  int iterations = 0;
  /// Error in the laws: the largest distance (N) between a contact's force and its projection onto
  /// the admissible forces, over the largest force.
  double residual = 0;
  /// False if the laws could not be satisfied to FrictionalContactSolver::kTolerance. `forces` then
  /// belong to slightly soft tools, or are the best found if `softness` is 0.
  bool converged = true;
  /// Largest added compliance of a contact, as a fraction of the compliance of its place.
  double softness = 0;
};

/// Solver for the forces of contacts whose displacements are d = free + D f. D (mm/N, 3 x 3 per
/// contact) is symmetric and positive definite, so there is exactly one solution without friction;
/// with friction there is exactly one for small coefficients.
///
/// Newton's method on the augmented Lagrangian form of the laws (P. Alart & A. Curnier, A mixed
/// formulation for frictional contact problems prone to Newton like solution methods, CMAME 92
/// (1991) 353-375), started from the previous forces. For a positive definite D it converges in a
/// few steps. Two contacts at nearly the same place make D singular or, by discretisation errors,
/// indefinite, and their conditions may contradict each other. Such contacts are soft: their own
/// compliance grows by up to kSharedSoftness, the more the closer they are, so that their forces
/// stay bounded; all other contacts satisfy the laws. If kMaxNewton steps still do not solve the
/// system, every contact becomes soft by the first value of kSoftness that suffices.
///
/// The work is bounded: each system gets at least kMinNewton steps, and more only until kMaxWork
/// multiplications are done in total, some milliseconds. With 10 contacts it never exceeds one
/// millisecond. The limit is a count and not a time, so that equal calls give equal forces.
///
/// One object per thread; after the first solve with equally many contacts it allocates no memory.
class FrictionalContactSolver {
 public:
  static constexpr double kTolerance = 1e-9;
  static constexpr int kMaxNewton = 25;
  static constexpr int kMinNewton = 4;
  static constexpr double kMaxWork = 5e6;
  /// Two contacts share a place if one, with the other grabbed, yields less than this fraction of
  /// its compliance alone: the size of discretisation errors.
  static constexpr double kSharedPlace = 2e-3;
  static constexpr double kSharedSoftness = 0.1;
  static constexpr double kSoftness[] = {1e-3, 1e-2, 1e-1};

  /// Solves for the forces. `compliance` is D, mm/N; `freeDisplacements` in mm, 3 per contact.
  /// `solution` contains the forces of the previous step (or zeros; for another number of contacts
  /// the iteration starts from zero) and receives the new ones.
  void solve(const Eigen::Ref<const Eigen::MatrixXd>& compliance,
             const Eigen::Ref<const Eigen::VectorXd>& freeDisplacements,
             std::span<const ContactCondition> conditions, ContactForces& solution);

 private:
  /// Data of one solve().
  struct Problem {
    Eigen::Ref<const Eigen::MatrixXd> compliance;
    Eigen::Ref<const Eigen::VectorXd> free;
    std::span<const ContactCondition> conditions;
  };
  double findSharedPlaces(const Problem& problem);
  void start(const Problem& problem, ContactForces& solution);
  /// Runs Newton's method; `solution` receives the best forces found.
  bool iterate(const Problem& problem, ContactForces& solution, double& work);
  /// Residual of the forces in `solution`; also sets the statuses.
  double residual(const Problem& problem, ContactForces& solution) const;
  /// Approximate number of multiplications of a Newton step.
  static double newtonWork(const ContactForces& solution);
  void newtonStep(const Problem& problem, ContactForces& solution);

  Eigen::VectorXd displacements_;  // for the current forces
  Eigen::VectorXd penalty_;        // per contact, N/mm: approximately its stiffness
  std::vector<Eigen::Index> active_;
  std::vector<ContactStatus> statuses_;
  Eigen::MatrixXd jacobian_;  // with right-hand side; larger than needed, so that it seldom grows
  Eigen::VectorXd step_, best_, stiff_, shared_, traces_;
  Eigen::MatrixXd softened_;
};

}  // namespace palpa::bem
