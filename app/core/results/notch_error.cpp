#include "app/core/results/notch_error.h"

#include <Eigen/Geometry>
#include <vector>

#include "base/support_border.h"
#include "bem/quadratic/quadratic_discretisation.h"

namespace palpa::app {

double notchError(const BoundarySetup& setup, const EnergyDensity& density, double energy) {
  if (!(energy > 0) || setup.splines) return 0;
  // Of the energy W h² per length: forces on a fork, a step, a groove, a frame and a cup were wrong
  // by 0.08 to 0.27 of it.
  constexpr double kMissed = 0.25;
  const bem::BoundaryMesh& mesh = setup.mesh();
  std::vector<bool> isHeld(mesh.triangles.size(), false);
  for (const BoundarySetup::Part& support : setup.supports)
    for (const int triangle : support.triangles) isHeld[static_cast<std::size_t>(triangle)] = true;
  const auto* quadratic = dynamic_cast<const bem::QuadraticDiscretisation*>(&*setup.discretisation);
  const auto hasRoots = [&](int node) {
    return quadratic && quadratic->surface().isOnBorder(node);
  };
  const auto isNotch = notchEdges(mesh.triangles, mesh.nodes, mesh.smoothingGroups, isHeld);
  double missed = 0;
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      if (!isNotch[t][k] || (hasRoots(from) && hasRoots(to))) continue;
      const double length = (mesh.nodes[to] - mesh.nodes[from]).norm();
      const double height = 2 * mesh.area(t) / length;
      missed += kMissed / 2 * density.at(t) * height * height * length;
    }
  return missed / energy;
}

}  // namespace palpa::app
