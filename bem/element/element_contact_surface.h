#pragma once

#include "bem/contact/contact_surface.h"
#include "bem/element/contact_elements.h"

namespace palpa::bem {

/// Surface of curved elements for contacts. The bump of a mask is projected element by element
/// (least squares over the element's own functions); each coefficient is the weighted mean of the
/// values that its elements give. So a mask that slides changes smoothly, and no system is solved.
///
/// The mean displacement is 2 ∫ b u dΓ - ∫ Φ u dΓ with the normalised bump b and its projection Φ.
/// Where Φ acts, ∫ Φ u differs from the compliance of b in first order of Φ - b; this mean differs
/// in second order, as the compliance is symmetric. Beside supports, b ends at their border.
class ElementContactSurface : public ContactSurface {
 public:
  SurfacePoint nearest(const Eigen::Vector3d& x) const override;

  std::unique_ptr<ContactSurface::Workspace> makeWorkspace() const override;
  /// Takes about 50 µs for the narrowest mask of cubic splines.
  bool makeMask(const SurfacePoint& point, double radius, ContactSurface::Workspace& workspace,
                ContactMask& mask) const override;

  double strainEnergy(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const override;

  /// Precomputed data of the elements.
  virtual const ContactElements& elements() const = 0;

 protected:
  using ContactSurface::ContactSurface;

 private:
  virtual int elementAt(const SurfacePoint& point) const = 0;

  class Workspace;
  double project(const Eigen::Vector3d& middle, double radius, Workspace& work,
                 ContactMask& mask) const;
  void addElement(const ContactElements::Element& element, Workspace& work,
                  ContactMask& mask) const;
  void integrate(Workspace& work) const;
};

}  // namespace palpa::bem
