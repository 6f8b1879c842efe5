#pragma once

#include <Eigen/Dense>

#include "bem/triangle/results.h"

namespace palpa::app {

/// Numbers that describe a stress independently of axes.
struct StressNumbers {
  Eigen::Vector3d principal;   ///< MPa, largest first
  Eigen::Matrix3d directions;  ///< columns: their unit directions
  double mean = 0;             ///< a third of the trace, MPa; the pressure is its negative
  double vonMises = 0;         ///< MPa
};

/// Numbers of the symmetric part of a stress (MPa).
inline StressNumbers stressNumbers(const Eigen::Matrix3d& stress) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver((stress + stress.transpose()) / 2);
  return {solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse(),
          stress.trace() / 3, bem::vonMises(stress)};
}

}  // namespace palpa::app
