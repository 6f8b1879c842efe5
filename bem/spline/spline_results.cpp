#include "bem/spline/spline_results.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/spline/gather.h"
#include "bem/spline/spline_body_force.h"
#include "bem/spline/spline_nearest.h"
#include "bem/spline/spline_projection.h"
#include "bem/spline/spline_rows.h"
#include "bem/spline/spline_state.h"
#include "bem/triangle/kelvin.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr double kTolerance = 1e-6;

}  // namespace

SplineResults::SplineResults(const SplineSurface& surface, const SplineTractions& tractions,
                             const Job& job)
    : surface_(surface), tractions_(tractions), quadrature_(surface, kTolerance, job) {}

Vector3d SplineResults::displacementDefect(const SplineMesh::Point& at, const Eigen::VectorXd& u,
                                           const Eigen::VectorXd& p, const Bulk& bulk) const {
  const SplineRows rows(surface_, tractions_, bulk.material, quadrature_);
  SplineRows::Sums sums;
  const SplineCollocationPoint point = surfacePlaces(surface_, at);
  rows.integrate(point, sums, Job{});
  Vector3d residual = rows.residual(sums, u, p);
  residual += SplineBodyForce(surface_, quadrature_, bulk).at(point, sums.quadrature);
  return rows.freeTerm(sums).partialPivLu().solve(residual);
}

Eigen::MatrixXd SplineResults::averageResidual(const BoundaryField& field, const Bulk& bulk,
                                               const Job& job) const {
  // With two points per direction, no point coincides with a collocation point of any degree.
  constexpr int kPoints = 2;
  constexpr std::ptrdiff_t kElementsPerTask = 4;
  struct Sample {
    SplinePlace place;
    double weight;
    Matrix3Xd residual;
  };
  std::vector<Sample> samples;
  std::vector<int> all(surface_.elements().size());
  std::iota(all.begin(), all.end(), 0);
  visitSplinePoints(surface_, all, kPoints, std::numeric_limits<double>::infinity(),
                    [&](const SplinePlace& place, const SplineJet&, double weight) {
                      samples.push_back({place, weight, {}});
                    });
  const SplineRows rows(surface_, tractions_, bulk.material, quadrature_);
  const SplineBodyForce bodyForce(surface_, quadrature_, bulk);
  ScratchPool<SplineRows::Sums> pool([] { return SplineRows::Sums{}; });
  const auto count = static_cast<std::ptrdiff_t>(samples.size());
  constexpr std::ptrdiff_t kPerTask = kElementsPerTask * kPoints * kPoints;
  parallelFor(
      (count + kPerTask - 1) / kPerTask, job, Phase::kErrorEstimate, [&](std::ptrdiff_t task) {
        SplineRows::Sums sums = pool.take();
        for (std::ptrdiff_t k = task * kPerTask; k < std::min(count, (task + 1) * kPerTask); ++k) {
          Sample& sample = samples[k];
          const SplineCollocationPoint point{surface_.evaluate(sample.place).position,
                                             {sample.place}};
          rows.integrate(point, sums, job);
          sample.residual = rows.residual(sums, field.u, field.p);
          if (bulk.hasBodyForce())
            sample.residual.colwise() += bodyForce.at(point, sums.quadrature);
        }
        pool.giveBack(std::move(sums));
      });

  const Index functions = surface_.coefficientCount();
  Eigen::MatrixXd average = Eigen::MatrixXd::Zero(3 * functions, field.u.cols());
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(functions);
  std::vector<double> basis;
  for (const Sample& sample : samples) {
    surface_.evaluateBasis(sample.place, basis);
    for (std::size_t f = 0; f < basis.size(); ++f) {
      const Index k = surface_.functions(sample.place.element)[f];
      average.middleRows<3>(3 * k) += sample.weight * basis[f] * sample.residual;
      areas[k] += sample.weight * basis[f];
    }
  }
  for (Index k = 0; k < functions; ++k)
    if (areas[k] > 0) average.middleRows<3>(3 * k) /= areas[k];
  return average;
}

std::optional<InteriorState> SplineResults::interiorState(const Eigen::VectorXd& u,
                                                          const Eigen::VectorXd& p,
                                                          const Bulk& bulk,
                                                          const Vector3d& x) const {
  const Material& material = bulk.material;
  const SplineFoot foot = nearestOnSurface(surface_, quadrature_, x);
  const SplineSurfaceState near = splineSurfaceState(
      surface_, tractions_, {foot.place.element, surface_.parameters(foot.place).parameters}, u, p,
      material);
  const auto linear = [&](const Vector3d& y) {
    return Vector3d(near.displacement + near.gradient * (y - near.position));
  };
  InteriorState state{linear(x), near.stress};
  if (foot.distance <= 1e-9 * surface_.boundingSize()) return state;

  SplineQuadrature::Workspace work;
  double solidAngle = 0;
  for (int e = 0; e < surface_.elementCount(); ++e) {
    const Matrix3Xd displacements = gather(u, surface_.functions(e)),
                    tractions = gather(p, tractions_.ofFunction[e]);
    const SplinePoints& points = quadrature_.points(e, x, nullptr, work);
    for (int k = 0; k < points.used; ++k) {
      const double size = points.areaSize()[k];
      if (!(size > 0)) continue;  // the metric is singular
      const Vector3d y(points.position(0)[k], points.position(1)[k], points.position(2)[k]);
      const Vector3d area(points.area(0)[k], points.area(1)[k], points.area(2)[k]);
      const Vector3d normal = area / size;
      const Eigen::Map<const Eigen::VectorXd> basis(
          points.basis.data() + static_cast<std::ptrdiff_t>(k) * quadrature_.stride(e),
          displacements.cols());
      const Vector3d displacement = displacements * basis - linear(y);
      const Vector3d traction = tractions * basis - near.stress * normal;
      state.displacement += size * (kelvinDisplacement(x, y, material) * traction -
                                    kelvinTraction(x, y, normal, material) * displacement);
      state.stress += size * (kelvinStressFromTraction(x, y, traction, material) +
                              kelvinStressFromDisplacement(x, y, normal, displacement, material));
      if (bulk.hasBodyForce()) {
        state.displacement += bodyForceDisplacement(y - x, area, bulk);
        state.stress += bodyForceStress(y - x, area, bulk);
      }
      solidAngle += (y - x).dot(area) / std::pow((y - x).norm(), 3);
    }
  }
  if (solidAngle < 2 * std::numbers::pi) return std::nullopt;
  return state;
}

Eigen::VectorXd SplineResults::bodyForceTerm(const SplineEquations& equations, const Bulk& bulk,
                                             const Job& job) const {
  return SplineBodyForce(surface_, quadrature_, bulk).term(equations, job);
}

BoundaryField estimatedError(const SplineResults& results, const ReferenceProblem& problem,
                             const BoundaryField& field, const Bulk& bulk, const Job& job) {
  const Eigen::MatrixXd average = results.averageResidual(field, bulk, job);
  const DegreesOfFreedom& dofs = problem.dofs();
  const Index points = dofs.count() / 3;
  Eigen::MatrixXd residual = Eigen::MatrixXd::Zero(dofs.count(), average.cols());
  for (Index k = 0; k < dofs.nodeCount(); ++k)
    for (int c = 0; c < 3; ++c) residual.row(c * points + k) = average.row(3 * k + c);
  return dofs.expand(problem.correction(residual), Eigen::MatrixXd());
}

}  // namespace palpa::bem
