#include "bem/contact/frictional_contact_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bem/linalg/dense_elimination.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using ConditionKind = ContactCondition::Kind;

/// Cost of a Newton step besides the elimination, per contact, in multiplications.
constexpr double kContactWork = 1000;

struct Projected {
  Vector3d force;
  ContactStatus status;
};

/// Admissible force nearest to f - penalty (d - value).
Projected project(const ContactCondition& condition, const Vector3d& f, const Vector3d& d,
                  double penalty) {
  const Vector3d trial = f - penalty * (d - condition.value);
  if (condition.kind == ConditionKind::kGrab) return {trial, ContactStatus::kGrabbed};
  if (condition.kind == ConditionKind::kForce) return {condition.value, ContactStatus::kForced};
  const double pressing = trial.dot(condition.normal);
  if (pressing <= 0) return {Vector3d::Zero(), ContactStatus::kOpen};
  const Vector3d tangential = trial - pressing * condition.normal;
  const double bound = condition.friction * pressing, length = tangential.norm();
  if (length <= bound) return {trial, ContactStatus::kSticking};
  return {pressing * condition.normal + (bound / length) * tangential, ContactStatus::kSlipping};
}

}  // namespace

void FrictionalContactSolver::solve(const Eigen::Ref<const Eigen::MatrixXd>& compliance,
                                    const Eigen::Ref<const Eigen::VectorXd>& freeDisplacements,
                                    std::span<const ContactCondition> conditions,
                                    ContactForces& solution) {
  const Problem problem{compliance, freeDisplacements, conditions};
  double work = 0;
  solution.iterations = 0;
  solution.softness = findSharedPlaces(problem);
  if (solution.softness == 0) {
    start(problem, solution);
    solution.converged = iterate(problem, solution, work);
    if (solution.converged) return;
  }
  solution.converged = false;
  start(problem, solution);
  stiff_ = solution.forces;
  const double everywhere[] = {0, kSoftness[0], kSoftness[1], kSoftness[2]};
  for (const double softness : everywhere) {
    if (softness == 0 && solution.softness == 0) continue;
    softened_ = compliance;
    for (Index k = 0; k < static_cast<Index>(conditions.size()); ++k)
      softened_.block<3, 3>(3 * k, 3 * k) *= 1 + shared_[k] + softness;
    const Problem soft{softened_, freeDisplacements, conditions};
    start(soft, solution);
    if (!iterate(soft, solution, work)) {
      solution.forces = stiff_;
      continue;
    }
    // The residual refers to the laws without softness.
    solution.softness = std::max(solution.softness, softness);
    statuses_ = solution.statuses;
    start(problem, solution);
    solution.residual = residual(problem, solution);
    std::swap(solution.statuses, statuses_);
    // Contacts at one place that carry no force satisfy the laws although they are soft.
    if (solution.residual <= kTolerance) {
      solution.softness = 0;
      solution.converged = true;
    }
    return;
  }
  solution.softness = 0;
  start(problem, solution);
  solution.residual = residual(problem, solution);
}

/// Stores the softness of contacts that grab or press at the place of another contact, and returns
/// the largest softness. The criterion is the compliance of one of two contacts while the other is
/// grabbed, as a fraction of its compliance alone.
double FrictionalContactSolver::findSharedPlaces(const Problem& problem) {
  const auto count = static_cast<Index>(problem.conditions.size());
  shared_.setZero(count);
  traces_.resize(count);
  for (Index k = 0; k < count; ++k)
    traces_[k] = problem.conditions[k].kind == ConditionKind::kForce
                     ? 0.0
                     : problem.compliance.block<3, 3>(3 * k, 3 * k).trace();
  double largest = 0;
  for (Index b = 1; b < count; ++b) {
    for (Index a = 0; a < b; ++a) {
      const double both = traces_[a] * traces_[b];
      if (both <= 0) continue;
      const double cross = problem.compliance(3 * a, 3 * b) +
                           problem.compliance(3 * a + 1, 3 * b + 1) +
                           problem.compliance(3 * a + 2, 3 * b + 2);
      const double left = 1 - cross * cross / both;
      if (left >= kSharedPlace) continue;
      const double softness = kSharedSoftness * std::min(1 - left / kSharedPlace, 1.0);
      for (const Index k : {a, b}) shared_[k] = std::max(shared_[k], softness);
      largest = std::max(largest, softness);
    }
  }
  return largest;
}

bool FrictionalContactSolver::iterate(const Problem& problem, ContactForces& solution,
                                      double& work) {
  double best = std::numeric_limits<double>::infinity();
  best_.setZero(solution.forces.size());
  const auto isGood = [&] {
    solution.residual = solution.forces.allFinite() ? residual(problem, solution)
                                                    : std::numeric_limits<double>::infinity();
    if (solution.residual < best) {
      best = solution.residual;
      best_ = solution.forces;
    }
    return solution.residual <= kTolerance;
  };
  bool good = isGood();
  for (int k = 0; !good && k < kMaxNewton; ++k) {
    work += newtonWork(solution);
    if (k >= kMinNewton && work > kMaxWork) break;
    newtonStep(problem, solution);
    ++solution.iterations;
    if (!solution.forces.allFinite()) solution.forces.setZero();
    displacements_.noalias() = problem.free + problem.compliance * solution.forces;
    good = isGood();
  }
  if (good) return true;
  solution.forces = best_;
  displacements_.noalias() = problem.free + problem.compliance * solution.forces;
  solution.residual = residual(problem, solution);
  return false;
}

void FrictionalContactSolver::start(const Problem& problem, ContactForces& solution) {
  const auto count = static_cast<Index>(problem.conditions.size());
  if (solution.forces.size() != 3 * count) solution.forces.setZero(3 * count);
  solution.statuses.resize(problem.conditions.size());
  penalty_.resize(count);
  for (Index k = 0; k < count; ++k) {
    // An unused mask has zero compliance and must have a prescribed force.
    const double trace = problem.compliance.block<3, 3>(3 * k, 3 * k).trace();
    penalty_[k] = trace > 0 ? 3.0 / trace : 0.0;
    // Prescribed forces hold from the start, so that they do not disturb the statuses of the
    // others.
    if (problem.conditions[k].kind == ConditionKind::kForce)
      solution.forces.segment<3>(3 * k) = problem.conditions[k].value;
  }
  displacements_.noalias() = problem.free + problem.compliance * solution.forces;
}

double FrictionalContactSolver::residual(const Problem& problem, ContactForces& solution) const {
  double worst = 0, largest = 0;
  for (std::size_t k = 0; k < problem.conditions.size(); ++k) {
    const auto row = 3 * static_cast<Index>(k);
    const Vector3d f = solution.forces.segment<3>(row);
    const auto allowed = project(problem.conditions[k], f, displacements_.segment<3>(row),
                                 penalty_[static_cast<Index>(k)]);
    solution.statuses[k] = allowed.status;
    worst = std::max(worst, (f - allowed.force).norm());
    largest = std::max({largest, f.norm(), allowed.force.norm()});
  }
  return largest > 0 ? worst / largest : 0.0;
}

double FrictionalContactSolver::newtonWork(const ContactForces& solution) {
  double size = 0;
  for (const ContactStatus status : solution.statuses)
    size += status == ContactStatus::kOpen || status == ContactStatus::kForced ? 0 : 3;
  return size * size * (size / 3 + 6) +
         kContactWork * static_cast<double>(solution.statuses.size());
}

void FrictionalContactSolver::newtonStep(const Problem& problem, ContactForces& solution) {
  // Contacts with known force (open or prescribed) are eliminated from the system.
  const auto count = static_cast<Index>(problem.conditions.size());
  step_.setZero(3 * count);
  active_.clear();
  for (Index k = 0; k < count; ++k) {
    const ContactStatus status = solution.statuses[k];
    if (status == ContactStatus::kOpen)
      step_.segment<3>(3 * k) = -solution.forces.segment<3>(3 * k);
    else if (status == ContactStatus::kForced)
      step_.segment<3>(3 * k) = problem.conditions[k].value - solution.forces.segment<3>(3 * k);
    else
      active_.push_back(k);
  }
  const auto size = 3 * static_cast<Index>(active_.size());
  if (jacobian_.rows() < size) jacobian_.resize(3 * count, 3 * count + 1);
  auto system = jacobian_.topLeftCorner(size, size + 1);
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const Index k = active_[i];
    const auto row = 3 * static_cast<Index>(i);
    const ContactCondition& condition = problem.conditions[k];
    const Vector3d f = solution.forces.segment<3>(3 * k);
    const Vector3d off = displacements_.segment<3>(3 * k) - condition.value;
    const double r = penalty_[k];
    // The laws are F(f, d) = 0 with the derivatives A with respect to d and B with respect to f.
    Matrix3d a = r * Matrix3d::Identity(), b = Matrix3d::Zero();
    Vector3d value = r * off;
    if (solution.statuses[k] == ContactStatus::kSlipping) {
      const Vector3d& n = condition.normal;
      const Matrix3d plane = Matrix3d::Identity() - n * n.transpose();
      const Vector3d trial = plane * (f - r * off);
      const double pressing = n.dot(f - r * off), length = trial.norm();
      // Without friction, a place that moves along the normal alone slips by rounding errors, or,
      // summed up in this order, not at all: it needs no direction then.
      const Vector3d e = length > 0 ? Vector3d(trial / length) : Vector3d::Zero();
      const double turning = length > 0 ? condition.friction * pressing / length : 0.0;
      const Matrix3d turn = turning * (plane - e * e.transpose());
      // F = r g n + f_t - μ (λ - r g) e
      value = r * n.dot(off) * n + plane * f - condition.friction * pressing * e;
      a = r * (n * n.transpose() + condition.friction * e * n.transpose() + turn);
      b = plane - condition.friction * e * n.transpose() - turn;
    }
    for (std::size_t j = 0; j < active_.size(); ++j)
      system.block<3, 3>(row, 3 * static_cast<Index>(j)).noalias() =
          a * problem.compliance.block<3, 3>(3 * k, 3 * active_[j]);
    system.block<3, 3>(row, row) += b;
    Vector3d moved = Vector3d::Zero();  // by the eliminated contacts
    for (Index j = 0; j < count; ++j)
      if (!step_.segment<3>(3 * j).isZero(0))
        moved += problem.compliance.block<3, 3>(3 * k, 3 * j) * step_.segment<3>(3 * j);
    system.col(size).segment<3>(row) = -value - a * moved;
  }
  if (size > 0) solveByElimination(system);
  for (std::size_t i = 0; i < active_.size(); ++i)
    step_.segment<3>(3 * active_[i]) = system.col(size).segment<3>(3 * static_cast<Index>(i));
  solution.forces += step_;
}

}  // namespace palpa::bem
