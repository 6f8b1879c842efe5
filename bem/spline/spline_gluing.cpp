#include "bem/spline/spline_gluing.h"

#include <Eigen/SparseCholesky>
#include <limits>
#include <vector>

#include "bem/base/error.h"
#include "bem/spline/spline_projection.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

constexpr int kPoints = 6;  // per direction: exact for products of two functions of degree 5

}  // namespace

Eigen::VectorXd gluedCoefficients(const SplineSurface& surface, const Eigen::VectorXd& u) {
  int netSize = surface.coefficientCount();
  for (int k = 0; k < surface.coefficientCount(); ++k)
    if (surface.tornFrom(k) != k) netSize = std::min(netSize, k);
  std::vector<int> unknownOf(static_cast<std::size_t>(netSize),
                             -1);  // per control point of the net
  int count = 0;
  const auto addUnknown = [&](int point) {
    if (unknownOf[point] < 0) unknownOf[point] = count++;
  };
  for (int k = netSize; k < surface.coefficientCount(); ++k) addUnknown(surface.tornFrom(k));
  for (int e = 0; e < surface.elementCount(); ++e)
    if (surface.borderFunctions(e))
      for (const int point : surface.net(e)) addUnknown(point);
  Eigen::VectorXd glued = u.head(3 * static_cast<Eigen::Index>(netSize));
  if (count == 0) return glued;

  std::vector<int> elements;
  for (int e = 0; e < surface.elementCount(); ++e)
    for (const int k : surface.net(e))
      if (unknownOf[surface.tornFrom(k)] >= 0) {
        elements.push_back(e);
        break;
      }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 3);
  std::vector<double> basis, values;
  visitSplinePoints(surface, elements, kPoints, std::numeric_limits<double>::infinity(),
                    [&](const ElementPlace& place, const SurfaceJet&, double weight) {
                      surface.evaluateBasis(place, values);
                      surface.evaluateNet(place.element, surface.parameters(place).parameters,
                                          basis);
                      const std::vector<int>& functions = surface.net(place.element);
                      // Displacement without the functions whose coefficients are known.
                      Vector3d torn = weightedSum(values, surface.functions(place.element), u);
                      for (std::size_t f = 0; f < basis.size(); ++f)
                        if (unknownOf[surface.tornFrom(functions[f])] < 0)
                          torn -= basis[f] * u.segment<3>(3 * functions[f]);
                      for (std::size_t a = 0; a < basis.size(); ++a) {
                        const int row = unknownOf[surface.tornFrom(functions[a])];
                        if (row < 0) continue;
                        right.row(row) += weight * basis[a] * torn.transpose();
                        for (std::size_t b = 0; b < basis.size(); ++b) {
                          const int column = unknownOf[surface.tornFrom(functions[b])];
                          if (column >= 0)
                            entries.emplace_back(row, column, weight * basis[a] * basis[b]);
                        }
                      }
                    });
  Eigen::SparseMatrix<double> mass(count, count);
  mass.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(mass);
  if (solver.info() != Eigen::Success)
    throw SolverError(SolverError::Kind::kBadMesh, "a patch of the solid has no area");
  const Eigen::MatrixXd x = solver.solve(right);
  for (int k = 0; k < netSize; ++k)
    if (unknownOf[k] >= 0) glued.segment<3>(3 * k) = x.row(unknownOf[k]).transpose();
  return glued;
}

}  // namespace palpa::bem
