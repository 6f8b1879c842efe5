#pragma once

#include <Eigen/Dense>
#include <vector>

#include "app/core/model/touch_model.h"

// The error of a state because the equations are solved on a mesh, not on the body's surface.
// Internal to the error estimates.
namespace palpa::app {

/// Strain energy per volume on the surface of a field. The model must outlive it.
class EnergyDensity {
 public:
  /// `u`, `p`: coefficients of the field.
  EnergyDensity(const BoundarySetup& setup, const Eigen::VectorXd& u, const Eigen::VectorXd& p);

  /// N/mm^2, at the middle of a triangle.
  double at(int triangle) const;

 private:
  const BoundarySetup& setup_;
  std::vector<Eigen::Matrix3d> stress_;
};

/// Relative error of the stiffness because the mesh does not follow the body's surface: the change
/// of the energy when a surface moves by the offset h is ∫ W h dΓ where it is free and -∫ W h dΓ
/// where it is held, with the strain energy W per volume (J. D. Eshelby, The elastic
/// energy-momentum tensor, J. Elasticity 5, 1975). The residual of the equations does not see this
/// error. `energy`: of the field, mJ. 0 where nothing moves. Throws Cancelled.
double shapeError(const TouchModel& model, const EnergyDensity& density, double energy,
                  const Job& job);

}  // namespace palpa::app
