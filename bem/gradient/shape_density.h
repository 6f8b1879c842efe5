#pragma once

#include "bem/contact/contact_mask.h"
#include "bem/gradient/field_sampler.h"

namespace palpa::bem {

/// Derivative of a number by the motion V (mm) of the surface:
///   Σ_q [ value_q · V(x_q) + Σ_a slope_qa · ∂V/∂t_a(x_q) ] + Σ_m centre_m · V(c_m)
/// over the points of a FieldSampler, with the tangents t_a of their frames, and over the centres
/// of masks. All of the surface is material: V also moves it along itself.
struct ShapeDensity {
  Eigen::Matrix3Xd value;  ///< one column per point
  Eigen::Matrix3Xd slope;  ///< two columns per point
  explicit ShapeDensity(int points)
      : value(Eigen::Matrix3Xd::Zero(3, points)), slope(Eigen::Matrix3Xd::Zero(3, 2 * points)) {}

  /// The derivative for a motion that is given at the points; for tests.
  double along(const Eigen::Matrix3Xd& motion, const Eigen::Matrix3Xd& slopes) const {
    return value.cwiseProduct(motion).sum() + slope.cwiseProduct(slopes).sum();
  }
};

/// Adds `factor` times the derivative of the energy ∫ σ(u_a):ε(u_b) dΩ of two fields whose supports
/// and loads move along with the material, without the change of the fields,
///   ∫ V · [ n σ(u_a):ε(u_b) − (∇u_a)ᵀ t(u_b) − (∇u_b)ᵀ t(u_a) ] dΓ
/// (Eshelby's tensor; docs/theory.md, "Gradients by the shape"). `a` and `b`: their states at the
/// points.
void addEnergyDensity(const FieldSampler& sampler, const std::vector<SampledState>& a,
                      const std::vector<SampledState>& b, double factor, ShapeDensity& density);

/// Adds `factor` times the derivative of the work ∫ Φ force·u dΓ of a mask by its own motion, u
/// staying with the material: its centre moves along with the material and its radius stays.
/// `states`: of u. `support`: where the mask has traction, as tractionValues(). Returns the
/// derivative by the motion of its centre.
Eigen::Vector3d addMaskDensity(const FieldSampler& sampler, const ContactMask& mask,
                               const Eigen::VectorXd& support, const Eigen::Vector3d& force,
                               const std::vector<SampledState>& states, double factor,
                               ShapeDensity& density);

}  // namespace palpa::bem
