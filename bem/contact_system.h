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
  /// False: the laws could not be met to ContactSystem::kTolerance; `forces` are the best found.
  bool converged = true;
};

/// Finds the forces of contacts whose displacements are d = free + D f. D (mm/N, 3 x 3 per contact)
/// is symmetric and positive definite, so that without friction there is exactly one solution; with
/// friction there is one for small coefficients.
///
/// Newton's method on the augmented Lagrangian form of the laws (P. Alart & A. Curnier, A mixed
/// formulation for frictional contact problems prone to Newton like solution methods, CMAME 92
/// (1991) 353-375), started from the forces before. When it does not come down in kMostNewton
/// steps, block Gauss-Seidel with projection, which converges without friction (J. J. Moreau; M.
/// Jean, The non-smooth contact dynamics method, CMAME 177 (1999) 235-257), in at most kMostSweeps
/// sweeps. So it always ends.
///
/// One object per thread; after the first solve with as many contacts nothing is allocated by it.
class ContactSystem {
 public:
  static constexpr double kTolerance = 1e-9;
  static constexpr int kMostNewton = 25;
  static constexpr int kMostSweeps = 2000;

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
  void start(const Problem& problem, ContactForces& solution);
  /// Of the forces in `solution`; also notes the statuses.
  double residual(const Problem& problem, ContactForces& solution) const;
  void newtonStep(const Problem& problem, ContactForces& solution);
  void sweep(const Problem& problem, ContactForces& solution);

  Eigen::VectorXd displacements_;  // of the forces at hand
  Eigen::VectorXd penalty_;        // per contact, N/mm: about its stiffness
  std::vector<Eigen::Index> active_;
  Eigen::MatrixXd jacobian_;  // and the right side; larger than needed, so that it seldom grows
  Eigen::VectorXd step_, best_;
};

}  // namespace palpa::bem
