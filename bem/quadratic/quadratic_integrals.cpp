#include "bem/quadratic/quadratic_integrals.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

#include "bem/element/gather.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Vector6d = Eigen::Matrix<double, 6, 1>;

Vector6d basisAt(const ElementPlace& place) {
  const QuadraticBasis basis(place.u, place.v);
  return Eigen::Map<const Vector6d>(basis.values.data());
}

}  // namespace

QuadraticIntegrals::QuadraticIntegrals(const QuadraticSurface& surface)
    : surface_(surface),
      elements_(static_cast<std::size_t>(surface.elementCount())),
      areas_(static_cast<std::size_t>(surface.coefficientCount()), 0) {
  // Area vectors of curved elements have no polynomial size: four cells leave errors of about 1e-9.
  constexpr int kCells = 2;
  std::vector<double> values;
  for (int e = 0; e < surface.elementCount(); ++e) {
    Element& element = elements_[e];
    element.moments.setZero();
    element.products.setZero();
    surface.visitPoints(
        e, kCells, [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
          const Vector6d basis = basisAt(place);
          surface.evaluateTractionBasis(place, values);
          const Eigen::Map<const Vector6d> ofTractions(values.data());
          element.products += weight * basis * ofTractions.transpose();
          element.moments.topRows<3>() += weight * jet.position * ofTractions.transpose();
          element.moments.row(3) += weight * ofTractions.transpose();
          for (int f = 0; f < 6; ++f) areas_[surface.coefficients(e)[f]] += weight * basis[f];
        });
  }
}

Resultant QuadraticIntegrals::resultant(const VectorXd& p, std::span<const int> elements) const {
  Resultant sum;
  for (const int e : elements)
    for (int f = 0; f < 6; ++f) {
      const Vector3d traction = p.segment<3>(3 * static_cast<Index>(surface_.slots(e)[f]));
      sum.force += elements_[e].moments(3, f) * traction;
      sum.moment += elements_[e].moments.col(f).head<3>().cross(traction);
    }
  return sum;
}

double QuadraticIntegrals::strainEnergy(const VectorXd& u, const VectorXd& p) const {
  double sum = 0;
  for (int e = 0; e < surface_.elementCount(); ++e) {
    const Eigen::Matrix3Xd tractions = gather(p, surface_.slots(e));
    if (tractions.isZero(0)) continue;
    sum += gather(u, surface_.coefficients(e))
               .cwiseProduct(tractions * elements_[e].products.transpose())
               .sum();
  }
  return 0.5 * sum;
}

VectorXd QuadraticIntegrals::projectTraction(const std::vector<int>& elements,
                                             const TractionFunction& traction,
                                             double featureLength) const {
  constexpr double kCellsPerFeature = 8;
  constexpr int kMaxCells = 64;
  const Index count = surface_.slotCount();
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
  for (const int e : elements) {
    double size = 0;
    for (const int node : surface_.coefficients(e))
      size =
          std::max(size, (surface_.nodes()[node] - surface_.evaluate({e, 0, 0}).position).norm());
    const int cells = static_cast<int>(
        std::clamp(std::ceil(kCellsPerFeature * size / featureLength), 1.0, 1.0 * kMaxCells));
    surface_.visitPoints(
        e, cells, [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
          const Vector3d value = weight * traction(jet.position, jet.areaVector().normalized());
          if (value.isZero(0)) return;
          const Vector6d basis = basisAt(place);
          for (int f = 0; f < 6; ++f)
            right.row(surface_.slots(e)[f]) += basis[f] * value.transpose();
        });
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int e = 0; e < surface_.elementCount(); ++e)
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        // No tractions are given in supports, whose functions are unbounded at their border.
        entries.emplace_back(
            surface_.slots(e)[a], surface_.slots(e)[b],
            surface_.hasBorderTractions(e) ? (a == b ? 1.0 : 0.0) : elements_[e].products(a, b));
  Eigen::SparseMatrix<double> mass(count, count);
  mass.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(mass);
  const Eigen::MatrixX3d solution = factors.solve(right);
  VectorXd coefficients(3 * count);
  for (Index s = 0; s < count; ++s) coefficients.segment<3>(3 * s) = solution.row(s).transpose();
  return coefficients;
}

}  // namespace palpa::bem
