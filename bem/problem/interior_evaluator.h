#pragma once

#include <Eigen/Dense>
#include <vector>

#include "base/job.h"
#include "bem/model/derived_quantities.h"
#include "bem/model/material.h"

namespace palpa::bem {

/// Evaluator of displacement and stress at many points inside a body (Somigliana's identities), for
/// one field after another. Made by Discretisation::makeInteriorEvaluator(). Immutable; const use
/// from several threads is safe.
class InteriorEvaluator {
 public:
  virtual ~InteriorEvaluator() = default;

  int pointCount() const { return static_cast<int>(points_.size()); }
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

  /// States at all points of one field in coefficients, which solves a problem with the body force
  /// that the evaluator was made for, on the job's threads. The result does not
  /// depend on their number. Throws Cancelled.
  std::vector<InteriorState> evaluate(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                      const Job& job) const {
    return evaluateAll(u, p, job);
  }

 protected:
  explicit InteriorEvaluator(std::vector<Eigen::Vector3d> points) : points_(std::move(points)) {}

 private:
  virtual std::vector<InteriorState> evaluateAll(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                                 const Job& job) const = 0;

  std::vector<Eigen::Vector3d> points_;
};

/// Strain of a stress in an isotropic material, by Hooke's law; regular at nu = 0.5.
inline Eigen::Matrix3d strainOf(const Eigen::Matrix3d& stress, const Material& material) {
  const double nu = material.poissonRatio;
  return ((1 + nu) * stress - nu * stress.trace() * Eigen::Matrix3d::Identity()) /
         material.youngsModulus;
}

}  // namespace palpa::bem
