#pragma once

#include "bem/model/material.h"
#include "bem/spline/spline_mesh.h"

namespace palpa::bem {

/// Cauchy stress at the slots of a mesh on a spline surface, computed from the traction and the
/// tangential derivatives of the displacement (see surfaceStress() in results.h) as the mean over
/// the elements that meet at the slot. Slopes are stored as weights, about 0.3 kB per slot, so one
/// evaluation takes 0.1 µs per slot. Const use from several threads is safe; the mesh must outlive
/// the stress.
class SplineMeshStress {
 public:
  explicit SplineMeshStress(const SplineMesh& mesh);

  /// Stress of each slot, MPa, for coefficients `u` (mm) and `p` (MPa).
  std::vector<Eigen::Matrix3d> stress(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                      const Material& material) const;

 private:
  /// Data of a slot for one of its elements.
  struct Place {
    int slot, element;
    double weight;  ///< in the mean over the elements of the slot
    Eigen::Matrix3d frame;
    Eigen::Matrix2Xd slopes;
  };
  const SplineMesh& mesh_;
  std::vector<Place> places_;
};

}  // namespace palpa::bem
