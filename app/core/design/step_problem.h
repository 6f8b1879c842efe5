#pragma once

#include <Eigen/Dense>
#include <vector>

namespace palpa::app {

/// Subproblem of one step of the search for a shape: of all x with |x_i| <= 1 and
/// |x_i - present_i| <= radius, the one that minimises
///
///   ½ |x|² + push · x + ½ Σ weight_r miss_r²
///
/// with miss_r = goal_r - value_r - slope_r · (x - present) of each row, of rows that are limits
/// only where it is positive. Convex, with one minimum; rows that contradict each other share the
/// misses by their weights.
struct StepProblem {
  struct Row {
    Eigen::VectorXd slope;
    double value = 0, goal = 0;
    double weight = 1;
    bool isLimit = false;  ///< the value must be at least the goal
  };
  Eigen::VectorXd present, push;  ///< of equal length; |present_i| <= 1
  double radius = 1;              ///< > 0
  std::vector<Row> rows;
};

struct StepSolution {
  Eigen::VectorXd x;
  std::vector<double> values;  ///< of the rows at x
  std::vector<double>
      pressure;  ///< of the rows: weight times miss; 0 for limits that do not matter
};

/// Solves the dual problem, whose variables are the multipliers of the rows alone, with NLopt's
/// SLSQP (Kraft 1994): concave and smooth, as the bounds on x are met in closed form. Takes about
/// 0.01 ms per variable and row.
StepSolution solveStep(const StepProblem& problem);

}  // namespace palpa::app
