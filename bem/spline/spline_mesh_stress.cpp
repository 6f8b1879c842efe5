#include "bem/spline/spline_mesh_stress.h"

#include <set>

#include "bem/spline/spline_state.h"
#include "bem/triangle/results.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::Matrix3d;

SplineMeshStress::SplineMeshStress(const SplineMesh& mesh) : mesh_(mesh) {
  const TractionSlots& slots = mesh.meshSlots();
  std::set<std::pair<int, int>> done;
  std::vector<int> count(slots.slots.size(), 0);
  for (int t = 0; t < mesh.mesh().triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const int slot = slots.ofCorner[t][corner];
      const SplineMesh::Point at = mesh.at(t, Eigen::Vector3d::Unit(corner));
      if (!done.emplace(slot, at.element).second) continue;
      SurfaceTangents tangents = splineTangents(mesh.surface(), at);
      places_.push_back({slot, at.element, 0, tangents.frame, std::move(tangents.slopes)});
      ++count[slot];
    }
  for (Place& place : places_) place.weight = 1.0 / count[place.slot];
}

std::vector<Matrix3d> SplineMeshStress::stress(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                               const Material& material) const {
  std::vector<Matrix3d> result(mesh_.meshSlots().slots.size(), Matrix3d::Zero());
  Eigen::MatrixXd tractions;
  mesh_.tractions(p, tractions);
  for (const Place& place : places_) {
    const std::vector<int>& functions = mesh_.surface().functions(place.element);
    Eigen::Matrix<double, 3, 2> slopes = Eigen::Matrix<double, 3, 2>::Zero();
    for (std::size_t f = 0; f < functions.size(); ++f)
      slopes += u.segment<3>(3 * static_cast<Index>(functions[f])) *
                place.slopes.col(static_cast<Index>(f)).transpose();
    result[place.slot] +=
        place.weight *
        surfaceStress(place.frame, slopes, tractions.col(0).segment<3>(3 * place.slot), material);
  }
  return result;
}

}  // namespace palpa::bem
