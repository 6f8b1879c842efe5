#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "app/view/viewport/viewport.h"
#include "modeling/solid/solid.h"

namespace palpa::render_tests {

/// A smooth displacement: `peak` at `at`, fading out over `radius`.
struct Dent {
  Eigen::Vector3d at, peak;
  double radius;

  Eigen::Vector3d operator()(const Eigen::Vector3d& place) const;
};

/// A body pressed and pulled at some places.
class Pressed {
 public:
  Pressed(const modeling::Solid& solid, std::vector<Dent> dents, int piecesPerSpan = 10);

  Eigen::Vector3d at(const Eigen::Vector3d& place) const;

  view::ScalarField displacement(double full) const;
  /// Outward movement of the surface, in the colours of a traction.
  view::ScalarField traction() const;

  /// The circle about `around`, a point of a sphere at the origin, on the moved surface.
  std::vector<Eigen::Vector3d> ring(const Eigen::Vector3d& around, double radius) const;

  /// For Viewport::setRegions(): the lowest part is fixed.
  std::vector<double> base() const;

  /// The moved body, its lowest part fixed, as fit() shows it at rest.
  void show(view::Viewport& viewport) const;

  view::ViewportBody rest, moved;

 private:
  std::vector<Dent> dents_;
};

}  // namespace palpa::render_tests
