#pragma once

#include <Eigen/Dense>
#include <functional>

#include "bem/model/material.h"

/// Exact solutions of linear elasticity, to compare with.
namespace palpa::verification {

struct ExactField {
  std::function<Eigen::Vector3d(const Eigen::Vector3d& x)> displacement;  ///< mm
  std::function<Eigen::Matrix3d(const Eigen::Vector3d& x)> stress;        ///< MPa
  Eigen::Vector3d bodyForce = Eigen::Vector3d::Zero();                    ///< N/mm^3
};

/// u = gradient x + shift. At nu = 0.5 the gradient must be trace-free, and the stress is its
/// deviatoric part minus `pressure`, which must be 0 for any other material.
ExactField linearField(const Eigen::Matrix3d& gradient, const Eigen::Vector3d& shift,
                       const bem::Material& material, double pressure = 0);

/// Field of a point force (N) at `source`, a place outside the body.
ExactField kelvinField(const Eigen::Vector3d& source, const Eigen::Vector3d& force,
                       const bem::Material& material);

/// Field of a bar along its body force (N/mm^3) that hangs from a plane: with s the coordinate
/// along b from `end`, the place of its free lower end, σ = -b s along b and nothing else.
/// Quadratic, for all materials.
ExactField hangingBarField(const Eigen::Vector3d& bodyForce, const Eigen::Vector3d& end,
                           const bem::Material& material);

/// The sum of two fields.
ExactField sum(const ExactField& a, const ExactField& b);

/// A gradient without symmetry; trace-free if requested.
Eigen::Matrix3d generalGradient(bool traceless);

/// Gradient of a function by central differences of order 4 with the given step; column j is the
/// derivative along axis j.
Eigen::Matrix3d differences(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& f,
                            const Eigen::Vector3d& at, double step);

/// The larger of two errors; infinite if one is not a number, so that it passes no comparison.
double worse(double error, double other);

/// Hooke's law, for nu < 0.5.
Eigen::Matrix3d hooke(const Eigen::Matrix3d& gradient, const bem::Material& material);

}  // namespace palpa::verification
