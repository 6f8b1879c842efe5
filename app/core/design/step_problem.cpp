#include "app/core/design/step_problem.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

namespace palpa::app {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The dual function with rows of length 1.
class Dual {
 public:
  explicit Dual(const StepProblem& problem)
      : problem_(problem),
        low_((problem.present.array() - problem.radius).cwiseMax(-1).matrix()),
        high_((problem.present.array() + problem.radius).cwiseMin(1).matrix()),
        slopes_(static_cast<Index>(problem.rows.size()), problem.present.size()),
        goals_(slopes_.rows()),
        softness_(slopes_.rows()),
        lengths_(slopes_.rows()) {
    for (Index r = 0; r < slopes_.rows(); ++r) {
      const StepProblem::Row& row = problem.rows[static_cast<std::size_t>(r)];
      lengths_[r] = std::max(row.slope.norm(), 1e-12);
      slopes_.row(r) = row.slope.transpose() / lengths_[r];
      goals_[r] = (row.goal - row.value) / lengths_[r] + slopes_.row(r).dot(problem.present);
      softness_[r] = 1 / (row.weight * lengths_[r] * lengths_[r]);
    }
  }

  VectorXd minimiser(const VectorXd& multipliers) const {
    return (slopes_.transpose() * multipliers - problem_.push).cwiseMax(low_).cwiseMin(high_);
  }

  /// Value to be maximised, and its derivative.
  double at(const VectorXd& multipliers, VectorXd& derivative) const {
    const VectorXd x = minimiser(multipliers);
    derivative = goals_ - slopes_ * x - softness_.cwiseProduct(multipliers);
    return x.squaredNorm() / 2 + problem_.push.dot(x) + multipliers.dot(goals_ - slopes_ * x) -
           softness_.cwiseProduct(multipliers).dot(multipliers) / 2;
  }

  /// Multiplier of a row over its pressure.
  double length(Index row) const { return lengths_[row]; }
  Index rows() const { return slopes_.rows(); }

 private:
  const StepProblem& problem_;
  VectorXd low_, high_;
  MatrixXd slopes_;
  VectorXd goals_, softness_, lengths_;
};

double evaluate(unsigned count, const double* x, double* derivative, void* data) {
  const auto& dual = *static_cast<const Dual*>(data);
  VectorXd slope;
  const double value = dual.at(Eigen::Map<const VectorXd>(x, static_cast<Index>(count)), slope);
  if (derivative) Eigen::Map<VectorXd>(derivative, static_cast<Index>(count)) = slope;
  return value;
}

VectorXd maximise(const Dual& dual, const StepProblem& problem) {
  constexpr int kEvaluations = 5000;
  VectorXd multipliers = VectorXd::Zero(dual.rows());
  if (dual.rows() == 0) return multipliers;
  VectorXd low = VectorXd::Constant(dual.rows(), -HUGE_VAL);
  for (Index r = 0; r < dual.rows(); ++r)
    if (problem.rows[static_cast<std::size_t>(r)].isLimit) low[r] = 0;
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> solver(
      nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(dual.rows())), nlopt_destroy);
  if (!solver) throw std::bad_alloc();
  nlopt_set_max_objective(solver.get(), evaluate, const_cast<Dual*>(&dual));
  nlopt_set_lower_bounds(solver.get(), low.data());
  nlopt_set_ftol_rel(solver.get(), 1e-14);
  nlopt_set_xtol_rel(solver.get(), 1e-10);
  nlopt_set_maxeval(solver.get(), kEvaluations);
  double value = 0;
  // A failed line search means, for a concave function, that rounding allows nothing better; the
  // multipliers are the best ones found.
  nlopt_optimize(solver.get(), multipliers.data(), &value);
  return multipliers;
}

}  // namespace

StepSolution solveStep(const StepProblem& problem) {
  const Dual dual(problem);
  const VectorXd multipliers = maximise(dual, problem);
  StepSolution solution;
  solution.x = dual.minimiser(multipliers);
  for (std::size_t r = 0; r < problem.rows.size(); ++r) {
    const StepProblem::Row& row = problem.rows[r];
    solution.values.push_back(row.value + row.slope.dot(solution.x - problem.present));
    solution.pressure.push_back(multipliers[static_cast<Index>(r)] /
                                dual.length(static_cast<Index>(r)));
  }
  return solution;
}

}  // namespace palpa::app
