#include "bem/contact_mask.h"

#include <cstdio>

#include "bem/error.h"
#include "bem/triangle_contact_surface.h"

namespace palpa::bem {

Eigen::MatrixXd ContactMask::displacement(const Eigen::MatrixXd& u) const {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(3, u.cols());
  for (std::size_t k = 0; k < measureNodes.size(); ++k)
    d += measure[k] * u.middleRows<3>(3 * measureNodes[k]);
  return d;
}

ContactMask makeContactMask(const ContactSurface& surface, const Eigen::Vector3d& at,
                            double radius) {
  ContactMask mask;
  const auto workspace = surface.makeWorkspace();
  if (surface.makeMask(surface.nearest(at), radius, *workspace, mask)) return mask;
  const Eigen::Vector3d& p = mask.point.position;
  char text[160];
  std::snprintf(text, sizeof text,
                "the place touched at (%.4g, %.4g, %.4g) mm is held by a support; touch the body "
                "where it is free",
                p[0], p[1], p[2]);
  throw SolverError(SolverError::Kind::kBadCondition, text);
}

ContactMask makeContactMask(const BoundaryMesh& mesh, const TractionSlots& slots,
                            const DegreesOfFreedom& dofs, const Eigen::Vector3d& at,
                            double radius) {
  return makeContactMask(TriangleContactSurface(mesh, slots, dofs), at, radius);
}

}  // namespace palpa::bem
