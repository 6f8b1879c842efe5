#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

namespace palpa::bem {

/// What one contact demands, with f its force on the body (N) and d its displacement (mm).
struct ContactCondition {
  enum class Kind {
    kHold,        ///< d = value
    kForce,       ///< f = value
    kUnilateral,  ///< Signorini and Coulomb, see below
  };
  Kind kind = Kind::kHold;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  /// kUnilateral: unit, along which the contact can press, into the body. With λ = f · normal and
  /// the gap g = (d - value) · normal: λ >= 0, g >= 0, λ g = 0. The tangential force f_t and the
  /// slip w = (d - value)_t obey |f_t| <= friction λ; w = 0 below that bound, and otherwise f_t
  /// points against w.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double friction = 0;  ///< Coulomb's coefficient, >= 0
};

enum class ContactStatus : unsigned char { kHeld, kForced, kOpen, kSticking, kSlipping };

struct ContactForces {
  Eigen::VectorXd forces;               ///< 3 per contact, N
  std::vector<ContactStatus> statuses;  ///< one per contact
  int iterations = 0;
  /// How well the laws hold: the largest difference (N) between a contact's force and its
  /// projection onto what the laws allow, over the largest force.
  double residual = 0;
  /// False: the laws could not be met to FrictionalContactSolver::kTolerance. `forces` are those of
  /// tools that are a little soft, or when `softness` is 0 the best found.
  bool converged = true;
  /// What contacts yield in addition at most, as a part of what their own places do.
  double softness = 0;
};

/// Finds the forces of contacts whose displacements are d = free + D f. D (mm/N, 3 x 3 per contact)
/// is symmetric and positive definite, so that without friction there is exactly one solution; with
/// friction there is one for small coefficients.
///
/// Newton's method on the augmented Lagrangian form of the laws (P. Alart & A. Curnier, A mixed
/// formulation for frictional contact problems prone to Newton like solution methods, CMAME 92
/// (1991) 353-375), started from the forces before. With a positive definite D it comes down in
/// some steps. Two contacts at nearly the same place make D singular or, by the errors of
/// discretisation, indefinite, and may demand what contradicts each other. They are soft: their own
/// compliance grows by up to kSharedSoftness, the more the nearer they are, so that their forces
/// stay bounded; all others obey the laws. When kMaxNewton steps do not solve the system all the
/// same, every contact is soft by the first of kSoftness that helps.
///
/// The work is bounded: each system gets kMinNewton steps whatever they cost, and more only until
/// kMaxWork multiplications are done in all, some milliseconds. With 10 contacts it never takes
/// more than one. A count, not a time, so that the same calls give the same forces.
///
/// One object per thread; after the first solve with as many contacts nothing is allocated by it.
class FrictionalContactSolver {
 public:
  static constexpr double kTolerance = 1e-9;
  static constexpr int kMaxNewton = 25;
  static constexpr int kMinNewton = 4;
  static constexpr double kMaxWork = 5e6;
  /// Contacts share a place when one with the other held yields less than this part of what it does
  /// alone: the size of the errors of discretisation.
  static constexpr double kSharedPlace = 2e-3;
  static constexpr double kSharedSoftness = 0.1;
  static constexpr double kSoftness[] = {1e-3, 1e-2, 1e-1};

  /// `solution` holds the forces of the step before (or zeros, or another number of contacts: then
  /// it starts afresh) and receives the new ones.
  void solve(const Eigen::Ref<const Eigen::MatrixXd>& compliance,
             const Eigen::Ref<const Eigen::VectorXd>& freeDisplacements,
             std::span<const ContactCondition> conditions, ContactForces& solution);

 private:
  /// The problem of one solve().
  struct Problem {
    Eigen::Ref<const Eigen::MatrixXd> compliance;
    Eigen::Ref<const Eigen::VectorXd> free;
    std::span<const ContactCondition> conditions;
  };
  double findSharedPlaces(const Problem& problem);
  void start(const Problem& problem, ContactForces& solution);
  /// Newton's method; leaves the best forces found.
  bool iterate(const Problem& problem, ContactForces& solution, double& work);
  /// Of the forces in `solution`; also notes the statuses.
  double residual(const Problem& problem, ContactForces& solution) const;
  /// Multiplications, about.
  static double newtonWork(const ContactForces& solution);
  void newtonStep(const Problem& problem, ContactForces& solution);

  Eigen::VectorXd displacements_;  // of the forces at hand
  Eigen::VectorXd penalty_;        // per contact, N/mm: about its stiffness
  std::vector<Eigen::Index> active_;
  std::vector<ContactStatus> statuses_;
  Eigen::MatrixXd jacobian_;  // and the right side; larger than needed, so that it seldom grows
  Eigen::VectorXd step_, best_, stiff_, shared_, traces_;
  Eigen::MatrixXd softened_;
};

}  // namespace palpa::bem
