#pragma once

#include "bem/contact/contact_mask.h"
#include "bem/gradient/mask_derivative.h"
#include "bem/model/boundary_mesh.h"

namespace palpa::bem {

/// maskDerivative() for the masks of flat triangles (TriangleContactSurface): the derivative by the
/// nodes of the mesh, one column each. The centre moves with its triangle.
Eigen::Matrix3Xd flatMaskDerivative(const BoundaryMesh& mesh, const TractionSlots& slots,
                                    const ContactMask& mask, const MaskWork& work,
                                    const Eigen::VectorXd& u);

}  // namespace palpa::bem
