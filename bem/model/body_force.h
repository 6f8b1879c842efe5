#pragma once

#include <Eigen/Dense>

#include "bem/model/boundary_mesh.h"
#include "bem/model/bulk.h"
#include "bem/model/derived_quantities.h"

/// Uniform body force b (N/mm^3) by integrals over the surface.
///
/// Kelvin's solution derives from Galerkin's vector G_lk = δ_lk R / (8 π G) (Danson 1981; Brebbia,
/// Telles & Wrobel 1984, section 5.7):  U_lk = G_lk,jj - G_lj,kj / (2 (1 - nu)).  With the
/// divergence theorem, the term of b in the boundary integral equation is, with r = y - x, e = r /
/// R and the outward normal n at y,
///   B_l(x) = ∫ U_lk b_k dV = 1 / (8 π G) ∮ [ b_l e.n - e_l b.n / (2 (1 - nu)) ] dΓ,
/// for x inside, on or outside the surface. The kernel is bounded and finite at nu = 0.5.
namespace palpa::bem {

/// Contribution of a surface element to B(x), mm: `r` from x to the element (mm, not zero), `area`
/// its outward area vector (mm^2).
Eigen::Vector3d bodyForceDisplacement(const Eigen::Vector3d& r, const Eigen::Vector3d& area,
                                      const Bulk& bulk);

/// Contribution of a surface element to the stress at the inner point x, MPa: Hooke's law for the
/// gradient of B,
///   σ_lm = 1 / (8 π) ∮ { b.n [ (1 - 2 nu) δ_lm - e_l e_m ] / (1 - nu) - (b_l n_m + b_m n_l)
///                        + e.n (b_l e_m + b_m e_l) } / R dΓ.
/// Finite at nu = 0.5, because the divergence of B is reduced by ∮ [ b.e e.n + b.n ] / R dΓ = 0.
Eigen::Matrix3d bodyForceStress(const Eigen::Vector3d& r, const Eigen::Vector3d& area,
                                const Bulk& bulk);

/// Displacement u* = -|ρ|² b / (4 G) and traction t* of a field without divergence that b causes,
/// with ρ the part of y - centre across b. Regular for all materials.
struct ParticularState {
  Eigen::Vector3d displacement;  ///< mm
  Eigen::Vector3d traction;      ///< MPa
};
ParticularState particularState(const Eigen::Vector3d& fromCentre, const Eigen::Vector3d& normal,
                                const Bulk& bulk);
/// Stress of the same field, MPa.
Eigen::Matrix3d particularStress(const Eigen::Vector3d& fromCentre, const Bulk& bulk);
/// Gradient of the same field: component i along axis k in row i, column k.
Eigen::Matrix3d particularGradient(const Eigen::Vector3d& fromCentre, const Bulk& bulk);

/// Work of the body force, ∫ b.u dV, for fields u, p that it and tractions p cause in the body. By
/// Betti's theorem with the particular state (u*, t*),
///   ∫ b.u dV = ∮ (p.u* - t*.u) dΓ + ∫ b.u* dV,
/// a linear function of the coefficients plus a constant.
struct BodyForceWork {
  Eigen::VectorXd ofDisplacement;  ///< 3 per displacement coefficient; empty without a body force
  Eigen::VectorXd ofTraction;      ///< 3 per slot
  double constant = 0;             ///< mJ

  /// mJ; zero without a body force.
  double value(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const {
    if (ofDisplacement.size() == 0) return 0;
    return ofDisplacement.dot(u) + ofTraction.dot(p) + constant;
  }
};

/// Volume and centroid of a body by integrals over its surface, collected point by point.
class VolumeMoments {
 public:
  /// `reference`: any point near the body, mm; it limits rounding far from the origin.
  explicit VolumeMoments(const Eigen::Vector3d& reference) : reference_(reference) {}

  /// A quadrature point with its outward area vector, mm and mm^2. By Euler's theorem the volume
  /// integral of a homogeneous function f of degree k is ∮ f y.n dΓ / (3 + k).
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& area) {
    const Eigen::Vector3d y = point - reference_;
    const double radial = y.dot(area);
    volume_ += radial / 3;
    first_ += radial / 4 * y;
    second_ += radial / 5 * y * y.transpose();
  }

  double volume() const { return volume_; }  ///< mm^3
  Eigen::Vector3d centroid() const { return reference_ + first_ / volume_; }
  /// ∫ (y - centroid) (y - centroid)ᵀ dV, mm^5.
  Eigen::Matrix3d secondMoments() const { return second_ - first_ * first_.transpose() / volume_; }
  /// Force and moment about the origin of a uniform body force (N/mm^3).
  Resultant resultant(const Eigen::Vector3d& bodyForce) const {
    const Eigen::Vector3d force = volume_ * bodyForce;
    return {force, centroid().cross(force)};
  }

 private:
  Eigen::Vector3d reference_;
  double volume_ = 0;
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero();
};

/// ∫ b.u* dV of the particular state about the centroid, mJ: the constant of BodyForceWork.
double particularWork(const VolumeMoments& moments, const Bulk& bulk);

}  // namespace palpa::bem
