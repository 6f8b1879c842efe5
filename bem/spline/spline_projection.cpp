#include "bem/spline/spline_projection.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "bem/base/error.h"
#include "bem/base/gauss_rule.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

constexpr int kPoints = 6;  ///< per direction: exact for products of two functions of degree 5
constexpr int kMaxCells = 64;

using Evaluate = std::function<void(const ElementPlace&, std::vector<double>&)>;

/// Solves ∫ N_a (Σ N_b x_b - f) dΓ = 0 for x, with the functions N that `evaluate` gives.
Eigen::VectorXd project(const Evaluate& evaluate, const SplineSurface& surface,
                        const std::vector<std::vector<int>>& unknowns, int count,
                        const std::vector<int>& elements, const SplineFunction& function,
                        double featureLength) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> basis;
  Eigen::MatrixXd ofElement;
  for (int e = 0; e < surface.elementCount(); ++e) {
    const std::vector<int>& list = unknowns[e];
    const auto size = static_cast<Eigen::Index>(list.size());
    ofElement.setZero(size, size);
    visitSplinePoints(surface, {e}, kPoints, INFINITY,
                      [&](const ElementPlace& place, const SurfaceJet&, double weight) {
                        evaluate(place, basis);
                        const Eigen::Map<const Eigen::VectorXd> values(basis.data(), size);
                        ofElement.noalias() += weight * values * values.transpose();
                      });
    for (Eigen::Index b = 0; b < size; ++b)
      for (Eigen::Index a = 0; a < size; ++a)
        entries.emplace_back(list[a], list[b], ofElement(a, b));
  }
  Eigen::SparseMatrix<double> mass(count, count);
  mass.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 3);
  visitSplinePoints(surface, elements, kPoints, featureLength / 8,
                    [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
                      evaluate(place, basis);
                      const Vector3d value =
                          weight * function(jet.position, jet.areaVector().normalized());
                      const std::vector<int>& list = unknowns[place.element];
                      for (std::size_t a = 0; a < list.size(); ++a)
                        right.row(list[a]) += basis[a] * value.transpose();
                    });
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(mass);
  if (solver.info() != Eigen::Success)
    throw SolverError(SolverError::Kind::kBadMesh,
                      "a patch of the solid has no area, so loads cannot be placed on it");
  const Eigen::MatrixXd x = solver.solve(right);
  return Eigen::Map<const Eigen::VectorXd>(Eigen::MatrixXd(x.transpose()).data(), 3 * count);
}

}  // namespace

void visitSplinePoints(
    const SplineSurface& surface, const std::vector<int>& elements, int pointsPerDirection,
    double cellSize,
    const std::function<void(const ElementPlace&, const SurfaceJet&, double)>& visit) {
  const GaussRule& rule = gaussRule(pointsPerDirection);
  for (const int e : elements) {
    const SplineElement& element = surface.elements()[e];
    const double width = element.upper[0] - element.lower[0];
    const double height = element.upper[1] - element.lower[1];
    const SurfaceJet middle =
        surface.evaluate({e, element.lower[0] + width / 2, element.lower[1] + height / 2});
    const auto cells = [&](double length) {
      return std::clamp(static_cast<int>(std::ceil(length / cellSize)), 1, kMaxCells);
    };
    const int columns = cells(middle.du.norm() * width), rows = cells(middle.dv.norm() * height);
    for (int b = 0; b < rows; ++b)
      for (int a = 0; a < columns; ++a)
        for (int j = 0; j < pointsPerDirection; ++j)
          for (int i = 0; i < pointsPerDirection; ++i) {
            const ElementPlace place{e, element.lower[0] + width * (a + rule.points[i]) / columns,
                                     element.lower[1] + height * (b + rule.points[j]) / rows};
            const SurfaceJet jet = surface.evaluate(place);
            visit(place, jet,
                  jet.areaVector().norm() * width * height * rule.weights[i] * rule.weights[j] /
                      (columns * rows));
          }
  }
}

Eigen::VectorXd projectTraction(const SplineSurface& surface, const SplineTractions& tractions,
                                const std::vector<int>& elements, const SplineFunction& traction,
                                double featureLength) {
  const auto evaluate = [&](const ElementPlace& place, std::vector<double>& values) {
    surface.evaluateTractionBasis(place, values);
  };
  return project(evaluate, surface, tractions.ofFunction, tractions.slots.count(), elements,
                 traction, featureLength);
}

Eigen::VectorXd projectDisplacement(const SplineSurface& surface, const SplineFunction& function) {
  std::vector<std::vector<int>> unknowns;
  std::vector<int> all;
  for (int e = 0; e < surface.elementCount(); ++e) {
    unknowns.push_back(surface.functions(e));
    all.push_back(e);
  }
  const auto evaluate = [&](const ElementPlace& place, std::vector<double>& values) {
    surface.evaluateBasis(place, values);
  };
  return project(evaluate, surface, unknowns, surface.coefficientCount(), all, function, INFINITY);
}

}  // namespace palpa::bem
