#include "bem/spline/spline_contact_surface.h"

#include "bem/spline/spline_collocation.h"

namespace palpa::bem {

using Eigen::Vector3d;

SplineContactSurface::SplineContactSurface(const SplineMesh& mesh, const DegreesOfFreedom& dofs)
    : ElementContactSurface(mesh.mesh(), mesh.meshSlots(), mesh.tractions().slots, dofs),
      mesh_(mesh),
      widths_(mesh.surface()),
      elements_(mesh.surface(), mesh.tractions(), widths_.ofFunctions()) {
  for (const CollocationPlace& point : grevilleCollocation(mesh.surface()))
    places_.push_back(point.position);
  coefficientAt_.assign(mesh.mesh().nodes.size(), -2);  // -2: not visited yet
  std::vector<double> basis;
  for (int t = 0; t < mesh.mesh().triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      int& coefficient = coefficientAt_[mesh.mesh().triangles[t][corner]];
      if (coefficient == -1) continue;
      const SplineMesh::Point at = mesh.at(t, Vector3d::Unit(corner));
      mesh.surface().evaluateBasis(at.element, at.parameters, basis);
      const std::vector<int>& functions = mesh.surface().functions(at.element);
      double most = 1e-6;  // smaller values are rounding errors
      int best = -1;
      for (std::size_t f = 0; f < basis.size(); ++f) {
        if (basis[f] <= most || !dofs.isFree(functions[f])) continue;
        most = basis[f];
        best = functions[f];
      }
      coefficient = best;
    }
}

}  // namespace palpa::bem
