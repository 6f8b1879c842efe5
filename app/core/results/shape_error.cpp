#include "app/core/results/shape_error.h"

#include <cmath>

namespace palpa::app {

EnergyDensity::EnergyDensity(const BoundarySetup& setup, const Eigen::VectorXd& u,
                             const Eigen::VectorXd& p)
    : setup_(setup), stress_(setup.discretisation->surfaceStress(u, p, setup.material)) {}

double EnergyDensity::at(int triangle) const {
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
  for (const int slot : setup_.meshSlots().ofCorner[static_cast<std::size_t>(triangle)])
    stress += stress_[static_cast<std::size_t>(slot)] / 3;
  return 0.5 * stress.cwiseProduct(bem::strainOf(stress, setup_.material)).sum();
}

double shapeError(const TouchModel& model, const EnergyDensity& density, double energy,
                  const Job& job) {
  if (!(energy > 0)) return 0;
  const bem::BoundaryMesh& mesh = model.setup().mesh();
  const std::vector<double>& offsets = model.surfaceOffsets(job);
  const auto changeAt = [&](int triangle) {
    return offsets[static_cast<std::size_t>(triangle)] * mesh.area(triangle) * density.at(triangle);
  };
  double all = 0, held = 0;
  for (int t = 0; t < mesh.triangleCount(); ++t) all += changeAt(t);
  for (const BoundarySetup::Part& support : model.setup().supports)
    for (const int triangle : support.triangles) held += changeAt(triangle);
  // Not the difference: W is unbounded at the borders of supports, and either integral inexact.
  return (std::abs(all - held) + std::abs(held)) / energy;
}

}  // namespace palpa::app
