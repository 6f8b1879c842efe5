#pragma once

#include "bem/model/material.h"
#include "bench/peers/surface_mask.h"
#include "bench/peers/tetrahedra.h"

namespace palpa::bench {

/// A grab computed by CalculiX.
struct CalculixGrab {
  Eigen::Vector3d force;  ///< of the touch on the body, N: the negative sum of the reactions
  double seconds = 0;
};

/// The grab of bem/contact/contact_mask.h on quadratic tetrahedra whose tagged faces are fixed: the
/// mean displacement Σ w u over the mask is prescribed for each axis by a linear constraint, whose
/// multiplier acts as a traction with the profile of the mask. Throws LeftOut if CalculiX fails.
CalculixGrab grabWithCalculix(const TetrahedralMesh& mesh, const bem::Material& material,
                              const SurfaceMask& mask, const Eigen::Vector3d& displacement);

}  // namespace palpa::bench
