#pragma once

#include <cmath>

#include "app/core/setup/boundary_setup.h"
#include "bench/peers/peer_case.h"

namespace palpa::bench {

/// The case's project: triangles with edges of `size` mm, or splines for a relative accuracy of
/// `size`, refined for the touch.
modeling::Project projectOf(const PeerCase& body, modeling::Engine engine, double size);

/// The case's triangle mesh with supports and loads, used by all methods except the splines.
app::BoundarySetup triangleSetup(const PeerCase& body, double size);

/// Relative error of the force of a touch, from its compliance and the case's reference.
double stiffnessError(const PeerCase& body, const Eigen::Matrix3d& compliance);

/// Relative L2 error of displacements, summed over points of the surface.
class SurfaceError {
 public:
  explicit SurfaceError(const PeerCase& body) : body_(body) {}
  void add(const Eigen::Vector3d& x, const Eigen::Vector3d& found, double weight);
  double relative() const { return std::sqrt(error_ / scale_); }

 private:
  const PeerCase& body_;
  double error_ = 0, scale_ = 0;
};

}  // namespace palpa::bench
