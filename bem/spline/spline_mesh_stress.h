#pragma once

#include "bem/model/material.h"
#include "bem/spline/spline_mesh.h"

namespace palpa::bem {

/// Cauchy stress at the slots of a mesh on a spline surface, from the traction and the tangential
/// derivatives of the displacement there (see surfaceStress() in results.h): the mean over the
/// elements that meet at the slot. Slopes are kept as weights, about 0.3 kB per slot, so that a
/// state costs 0.1 µs per slot. Const use from several threads is safe; the mesh must outlive it.
class SplineMeshStress {
 public:
  explicit SplineMeshStress(const SplineMesh& mesh);

  /// MPa.
  std::vector<Eigen::Matrix3d> stress(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                      const Material& material) const;

 private:
  /// A slot as seen from one of its elements.
  struct Place {
    int slot, element;
    double weight;  ///< in the mean of the slot
    Eigen::Matrix3d frame;
    Eigen::Matrix2Xd slopes;
  };
  const SplineMesh& mesh_;
  std::vector<Place> places_;
};

}  // namespace palpa::bem
