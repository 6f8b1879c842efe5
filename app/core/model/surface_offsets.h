#pragma once

#include <vector>

#include "base/job.h"
#include "bem/problem/discretisation.h"
#include "modeling/body/body.h"

namespace palpa::app {

/// How far a body's surface lies outside of the surface on which its equations are solved, which
/// meets it at nodes alone: flat triangles cut convex parts off, and coarse quadratic ones do so to
/// some extent. Immutable.
struct SurfaceOffsets {
  /// `isExact`: the equations are solved on the body's surface; the offsets are zero. Throws
  /// Cancelled.
  SurfaceOffsets(const modeling::Body& body, const bem::Discretisation& on, bool isExact,
                 const Job& job);

  /// mm, along the outward normal, the mean over each triangle of the mesh. An edge farther than
  /// half of its length from the body counts as on it: the mesh leaves a feature out there.
  std::vector<double> ofTriangle;
};

}  // namespace palpa::app
