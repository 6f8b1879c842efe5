#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bem/model/material.h"

namespace palpa::app::test {

/// Reference solution of a heavy sphere about the origin whose surface below a height is fixed, by
/// axisymmetric finite elements: biquadratic, in polar coordinates, graded geometrically towards
/// the rim of the support, where the stress is singular. Displacements change by 4e-4 from 14 to 18
/// levels, and by less than 1e-4 from there on. Shares nothing with the program but the
/// material. The weight acts along -z.
class AxisymmetricSphere {
 public:
  /// `fixedBelow`: z in mm; `weight`: N/mm^3; `levels`: elements halve about this often towards the
  /// rim.
  AxisymmetricSphere(double radius, double fixedBelow, const bem::Material& material, double weight,
                     int levels = 22);

  /// Displacement along r and z, mm, at the node of the surface nearest to an angle from the lowest
  /// point; `angle` becomes the node's.
  Eigen::Vector2d surfaceDisplacement(double& angle) const;
  double energy() const { return energy_; }  ///< mJ
  double volume() const { return volume_; }  ///< mm^3
  int unknowns() const { return static_cast<int>(u_.size()); }

 private:
  int node(int i, int j) const { return j == 0 ? 0 : 1 + i + (j - 1) * alongSize_; }

  std::vector<double> angles_, radii_;  ///< of the nodes, mid-side nodes included
  int alongSize_ = 0;
  Eigen::VectorXd u_;
  double energy_ = 0, volume_ = 0;
};

}  // namespace palpa::app::test
