#pragma once

#include <Eigen/Dense>
#include <vector>

namespace palpa::bem {

/// Point of a rule for integrals over the surface.
struct SampledPoint {
  Eigen::Vector3d position;  ///< mm
  Eigen::Matrix3d frame;     ///< columns: two tangents, the outward normal
  double weight;             ///< mm^2; the weights sum to the area
};

/// Points of a rule over the whole surface, with the functions of the displacement and the traction
/// there. The points come in blocks, one per element, whose functions are evaluated once. Const use
/// from several threads is safe. Memory: about 500 bytes per point of a cubic element.
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

  /// As Block, with the range of its points.
  struct Functions {
    int first, count;  ///< of points()
    std::vector<int> coefficients, slots;
    Eigen::MatrixXd displacement, traction;
  };
  const std::vector<Functions>& blocks() const { return blocks_; }

 private:
  std::vector<SampledPoint> points_;
  std::vector<Functions> blocks_;
};

}  // namespace palpa::bem
