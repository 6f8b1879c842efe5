#pragma once

#include "bem/contact/contact_surface.h"
#include "bem/spline/spline_contact_elements.h"
#include "bem/spline/spline_mask_widths.h"
#include "bem/spline/spline_mesh.h"

namespace palpa::bem {

/// The surface of a spline discretisation, for contacts. Points are named by the triangles of a
/// mesh on it but lie on the splines: normals, feet and distances are those of the true surface.
///
/// Masks are not L2-projected but by the mean of the projections onto the polynomials of each
/// element (D. C. Thomas et al., Bézier projection, CMAME 284 (2015) 55-105): with P_e the
/// coefficients of the L2 projection on element e alone,
///   φ_j = Σ_e (∫_e N_j / ∫ N_j) P_e,j.
/// It keeps splines and the integral, needs no system to be solved, and is smooth in the place of
/// the bump: a function that the bump just reaches begins with zero, so that the force of a sliding
/// contact has no steps. An L2 projection onto the functions that the bump reaches needs them faded
/// in, which costs up to 30 % of the mean ρ^2 at r = 1.7 elements; here that is kept to about 10 %,
/// from 2.2 elements on to 4 %.
///
/// Costs about 0.1 ms and 10 kB per cubic element to make and to keep.
class SplineContactSurface final : public ContactSurface {
 public:
  /// Both must outlive it.
  SplineContactSurface(const SplineMesh& mesh, const DegreesOfFreedom& dofs);

  const std::vector<Eigen::Vector3d>& places() const override { return places_; }
  int coefficientAt(int meshNode) const override { return coefficientAt_[meshNode]; }

  SurfacePoint at(int triangle, const Eigen::Vector3d& weights) const override;
  SurfacePoint nearest(const Eigen::Vector3d& x) const override;
  SurfacePoint foot(const Eigen::Vector3d& tool, const SurfacePoint& start) const override;

  Eigen::Vector3d normal(const SurfacePoint& point) const override;
  Eigen::Vector3d smoothPosition(const SurfacePoint& point) const override;

  /// SplineMaskWidths: of uniform cubic elements h 1.73 h, of quadratic ones 1.5 h. The middle of
  /// such a mask is up to 6 % (19 %) off the height of the bump, the mask as a whole about 13 % (17
  /// %) in the L2 norm.
  double narrowestMask(const SurfacePoint& point) const override;
  double maskSpacing(const SurfacePoint& point) const override;

  std::unique_ptr<ContactSurface::Workspace> makeWorkspace() const override;
  /// Cost: about 50 µs for the narrowest mask of cubic splines.
  bool makeMask(const SurfacePoint& point, double radius, ContactSurface::Workspace& workspace,
                ContactMask& mask) const override;

  double strainEnergy(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const override;

 private:
  class Workspace;
  double project(const Eigen::Vector3d& middle, double radius, Workspace& work,
                 ContactMask& mask) const;
  double measure(Workspace& work, ContactMask& mask) const;

  const SplineMesh& mesh_;
  SplineMaskWidths widths_;
  SplineContactElements elements_;
  std::vector<Eigen::Vector3d> places_;
  std::vector<int> coefficientAt_;  // per node of the mesh
};

}  // namespace palpa::bem
