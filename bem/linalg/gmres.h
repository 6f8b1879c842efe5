#pragma once

#include <Eigen/Dense>
#include <functional>

#include "base/job.h"

namespace palpa::bem {

struct GmresSolution {
  Eigen::MatrixXd x;
  int steps = 0;        ///< applications of the map
  double residual = 0;  ///< |b - A x| / |b|, the largest of all columns
};

/// Solves A x = b for several right-hand sides together by GMRES without restarts (Saad and Schultz
/// 1986), a Krylov space per column. `apply`: A times the columns of a matrix. Stops when all
/// columns have reached the tolerance, or after `maxSteps`. Memory: one matrix like b per step.
/// Throws Cancelled.
GmresSolution gmres(const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& apply,
                    const Eigen::MatrixXd& b, double tolerance, int maxSteps, const Job& job);

}  // namespace palpa::bem
