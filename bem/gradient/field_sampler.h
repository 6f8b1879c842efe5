#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "base/job.h"
#include "bem/model/material.h"

namespace palpa::bem {

/// Point of a rule for integrals over the surface.
struct SampledPoint {
  Eigen::Vector3d position;  ///< mm
  Eigen::Matrix3d frame;     ///< columns: two tangents, the outward normal
  double weight;             ///< mm^2; the weights sum to the area
};

/// A field at such a point.
struct SampledState {
  Eigen::Vector3d displacement;  ///< mm
  Eigen::Vector3d traction;      ///< MPa
  Eigen::Matrix3d gradient;      ///< of the displacement; column j: derivative along axis j
  Eigen::Matrix3d stress;        ///< Cauchy, MPa
};

/// Fields in coefficients at the points of a rule over the whole surface: displacement, traction,
/// gradient and stress, linear in the field. The points come in blocks, one per element, whose
/// functions are evaluated once. Const use from several threads is safe. Memory: about 500 bytes
/// per point of a cubic element.
class FieldSampler {
 public:
  /// One element: its displacement coefficients and traction slots.
  /// `displacement`: three rows per point, one column per coefficient: the values of the functions
  /// and their derivatives along the two tangents (1/mm). `traction`: one row per point, one column
  /// per slot.
  struct Block {
    std::vector<SampledPoint> points;
    std::vector<int> coefficients, slots;
    Eigen::MatrixXd displacement, traction;
  };
  void add(Block block);

  int pointCount() const { return static_cast<int>(points_.size()); }
  const std::vector<SampledPoint>& points() const { return points_; }
  double area() const;

  /// States of a field (3 rows per coefficient and per slot, one column) at all points, in their
  /// order. About 0.2 µs per point of a cubic element and core; the result does not depend on the
  /// number of threads. Throws Cancelled.
  std::vector<SampledState> evaluate(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                     const Material& material, const Job& job = {}) const;
  /// Values at all points of a scalar traction field that is given by a few slots.
  Eigen::VectorXd tractionValues(std::span<const int> slots, std::span<const double> values,
                                 int slotCount) const;

 private:
  struct Functions {
    int first, count;  ///< of points_
    std::vector<int> coefficients, slots;
    Eigen::MatrixXd displacement, traction;
  };
  std::vector<SampledPoint> points_;
  std::vector<Functions> blocks_;
};

}  // namespace palpa::bem
