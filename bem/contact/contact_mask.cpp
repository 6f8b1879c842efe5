#include "bem/contact/contact_mask.h"

#include "base/text.h"
#include "bem/base/error.h"
#include "bem/contact/contact_surface.h"

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
  throw SolverError(SolverError::Kind::kBadCondition,
                    "the place touched at " + placeText(mask.point.position) +
                        " is fixed by a support; touch a free place");
}

}  // namespace palpa::bem
