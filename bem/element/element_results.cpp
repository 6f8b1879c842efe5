#include "bem/element/element_results.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/element/element_body_force.h"
#include "bem/element/element_rows.h"
#include "bem/element/gather.h"
#include "bem/element/residuals.h"
#include "bem/triangle/kelvin.h"

namespace palpa::bem {
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

namespace {

/// Sine of the angle of the tangents below which the metric counts as singular.
constexpr double kMinSine = 0.02;

/// Number of elements from which residuals at many points are interpolated within clusters.
constexpr int kClustersFrom = 400;

}  // namespace

bool ElementResults::isRegular(const CollocationPlace& at) const {
  return std::all_of(at.places.begin(), at.places.end(), [&](const ElementPlace& place) {
    const SurfaceJet jet = surface_.evaluate(place);
    return jet.areaVector().norm() > kMinSine * jet.du.norm() * jet.dv.norm();
  });
}

Vector3d ElementResults::displacementDefect(const CollocationPlace& at, const Eigen::VectorXd& u,
                                            const Eigen::VectorXd& p, const Bulk& bulk) const {
  if (!isRegular(at)) return Vector3d::Zero();
  const ElementRows rows(surface_, quadrature_, bulk.material);
  ElementRows::Sums sums;
  rows.integrate(at, sums, Job{});
  Vector3d residual = rows.residual(sums, u, p);
  residual += ElementBodyForce(surface_, quadrature_, bulk).at(at, *sums.quadrature);
  return rows.freeTerm(sums).partialPivLu().solve(residual);
}

std::vector<Matrix3Xd> ElementResults::residuals(std::span<const CollocationPlace> points,
                                                 const BoundaryField& field, const Bulk& bulk,
                                                 const Job& job) const {
  constexpr Phase kPhase = Phase::kErrorEstimate;
  constexpr std::ptrdiff_t kPerTask = 16;
  const auto count = static_cast<std::ptrdiff_t>(points.size());
  const auto forPoints = [&](const auto& use) {
    ScratchPool<ElementRows::Sums> pool([&] {
      ElementRows::Sums sums;
      sums.quadrature = quadrature_.makeWorkspace();
      return sums;
    });
    parallelFor((count + kPerTask - 1) / kPerTask, job, kPhase, [&](std::ptrdiff_t task) {
      ElementRows::Sums sums = pool.take();
      for (std::ptrdiff_t k = task * kPerTask; k < std::min(count, (task + 1) * kPerTask); ++k)
        use(k, sums);
      pool.giveBack(std::move(sums));
    });
  };
  std::vector<Matrix3Xd> residuals(points.size());
  if (surface_.elementCount() >= kClustersFrom) {
    residuals = residualsAt(points, surface_, quadrature_, bulk.material, field, kPhase, job);
  } else {
    const ElementRows rows(surface_, quadrature_, bulk.material);
    forPoints([&](std::ptrdiff_t k, ElementRows::Sums& sums) {
      rows.integrate(points[k], sums, job);
      residuals[k] = rows.residual(sums, field.u, field.p);
    });
  }
  if (bulk.hasBodyForce()) {
    const ElementBodyForce bodyForce(surface_, quadrature_, bulk);
    forPoints([&](std::ptrdiff_t k, const ElementRows::Sums& sums) {
      residuals[k].colwise() += bodyForce.at(points[k], *sums.quadrature);
    });
  }
  return residuals;
}

Eigen::MatrixXd ElementResults::averageResidual(const BoundaryField& field, const Bulk& bulk,
                                                const Job& job) const {
  std::vector<WeightedPlace> samples;
  for (int e = 0; e < surface_.elementCount(); ++e) surface_.samplePlaces(e, samples);
  std::vector<CollocationPlace> points;
  for (const WeightedPlace& sample : samples)
    points.push_back({surface_.evaluate(sample.place).position, {sample.place}});
  const std::vector<Matrix3Xd> ofPoints = residuals(points, field, bulk, job);
  const Index functions = surface_.coefficientCount();
  Eigen::MatrixXd average = Eigen::MatrixXd::Zero(3 * functions, field.u.cols());
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(functions);
  std::vector<double> basis;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const auto& [place, weight] = samples[s];
    surface_.evaluateShares(place, basis);
    for (std::size_t f = 0; f < basis.size(); ++f) {
      const Index k = surface_.coefficients(place.element)[f];
      average.middleRows<3>(3 * k) += weight * basis[f] * ofPoints[s];
      areas[k] += weight * basis[f];
    }
  }
  for (Index k = 0; k < functions; ++k)
    if (areas[k] > 0) average.middleRows<3>(3 * k) /= areas[k];
  return average;
}

std::optional<InteriorState> ElementResults::interiorState(const Eigen::VectorXd& u,
                                                           const Eigen::VectorXd& p,
                                                           const Bulk& bulk,
                                                           const Vector3d& x) const {
  const Material& material = bulk.material;
  const ElementFoot foot = nearestOnSurface(surface_, quadrature_, x);
  const SurfaceState near = surface_.state(foot.place, u, p, material);
  const auto linear = [&](const Vector3d& y) {
    return Vector3d(near.displacement + near.gradient * (y - near.position));
  };
  InteriorState state{linear(x), near.stress};
  if (foot.distance <= 1e-9 * surface_.boundingSize()) return state;

  const std::unique_ptr<ElementQuadrature::Workspace> work = quadrature_.makeWorkspace();
  double solidAngle = 0;
  Eigen::VectorXd basis;
  for (int e = 0; e < surface_.elementCount(); ++e) {
    const Matrix3Xd displacements = surface_.displacementsOfTable(e, u),
                    tractions = surface_.tractionsOfTable(e, p);
    const ElementPoints& points = quadrature_.points(e, x, nullptr, *work);
    for (int k = 0; k < points.used; ++k) {
      const Vector3d y = points.positionOf(k), area = points.areaOf(k);
      const double size = area.norm();
      if (!(size > 0)) continue;  // the metric is singular
      const Vector3d normal = area / size;
      points.basisAt(k, basis);
      const Vector3d displacement = displacements * basis - linear(y);
      const Vector3d traction =
          points.tractionArea()[k] / size * (tractions * basis) - near.stress * normal;
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

Eigen::VectorXd ElementResults::bodyForceTerm(const WeightedEquations& equations, const Bulk& bulk,
                                              const Job& job) const {
  return ElementBodyForce(surface_, quadrature_, bulk).term(equations, job);
}

BoundaryField estimatedError(const ElementResults& results, const ReferenceProblem& problem,
                             const BoundaryField& field, const Bulk& bulk,
                             const std::function<double(int)>& share, const Job& job) {
  const Eigen::MatrixXd average = results.averageResidual(field, bulk, job);
  const DegreesOfFreedom& dofs = problem.dofs();
  const Index points = dofs.count() / 3;
  Eigen::MatrixXd residual = Eigen::MatrixXd::Zero(dofs.count(), average.cols());
  for (int k = 0; k < dofs.nodeCount(); ++k) {
    const double part = share(k);
    for (int c = 0; c < 3; ++c) residual.row(c * points + k) = part * average.row(3 * k + c);
  }
  return dofs.expand(problem.correction(residual), Eigen::MatrixXd());
}

}  // namespace palpa::bem
