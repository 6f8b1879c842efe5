#include "bem/element/residuals.h"

#include <gtest/gtest.h>

#include <stop_token>

#include "app/verification/exact/simple_meshes.h"
#include "bem/element/element_rows.h"
#include "bem/quadratic/quadratic_quadrature.h"
#include "quadratic_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;

const Material kMaterial{0.1, 0.4};

/// A smooth field on a body and the sample places of all its elements.
struct Sampled {
  explicit Sampled(std::unique_ptr<QuadraticDiscretisation> discretisation)
      : on(std::move(discretisation)), quadrature(on->surface(), 1e-6) {
    std::vector<WeightedPlace> samples;
    for (int e = 0; e < on->surface().elementCount(); ++e) on->surface().samplePlaces(e, samples);
    for (const WeightedPlace& sample : samples)
      points.push_back({on->surface().evaluate(sample.place).position, {sample.place}});
    field.u.resize(3 * static_cast<Index>(on->displacementCount()), 2);
    field.p.resize(3 * static_cast<Index>(on->slots().count()), 2);
    const double size = on->surface().boundingSize();
    for (Index k = 0; 3 * k < field.u.rows(); ++k) {
      const Vector3d x = on->places()[k] / size;
      field.u.block<3, 1>(3 * k, 0) = Vector3d(x.y() * x.y(), 1 + x.x() * x.z(), x.x());
      field.u.block<3, 1>(3 * k, 1) = Vector3d(2, x.z(), -x.x() * x.x());
    }
    for (Index s = 0; 3 * s < field.p.rows(); ++s)
      field.p.middleRows<3>(3 * s).setConstant(0.01 * static_cast<double>(s % 7));
  }

  std::vector<Matrix3Xd> residuals(const Job& job = {}) const {
    return residualsAt(points, on->surface(), quadrature, kMaterial, field, Phase::kErrorEstimate,
                       job);
  }

  /// Largest difference from sums over all elements, over the largest displacement.
  double largestDifference() const {
    const ElementRows rows(on->surface(), quadrature, kMaterial);
    ElementRows::Sums sums;
    const std::vector<Matrix3Xd> found = residuals();
    double largest = 0;
    for (std::size_t k = 0; k < points.size(); k += 5) {
      rows.integrate(points[k], sums, {});
      largest = std::max(largest,
                         (found[k] - rows.residual(sums, field.u, field.p)).cwiseAbs().maxCoeff());
    }
    return largest / field.u.cwiseAbs().maxCoeff();
  }

  std::unique_ptr<QuadraticDiscretisation> on;
  QuadraticQuadrature quadrature;
  std::vector<CollocationPlace> points;
  BoundaryField field;
};

TEST(Residuals, AgreeWithSumsOverAllElements) {
  const Sampled sphere(quadratic(verification::sphereMesh(25, 9), onSphere(25)));
  EXPECT_LT(sphere.largestDifference(), 5e-4);
  // Elongated, with flat faces along the axes.
  const Sampled box(
      quadratic(verification::boxMesh(Vector3d::Zero(), {90, 15, 6}, 30, 5, 2), onFlatFaces));
  EXPECT_LT(box.largestDifference(), 5e-4);
}

TEST(Residuals, OfABodyWithFewElementsHaveNoDistantOnes) {
  const Sampled sphere(quadratic(verification::sphereMesh(25, 2), onSphere(25)));
  EXPECT_LT(sphere.largestDifference(), 1e-12);
  EXPECT_TRUE(residualsAt({}, sphere.on->surface(), sphere.quadrature, kMaterial, sphere.field,
                          Phase::kErrorEstimate, {})
                  .empty());
}

TEST(Residuals, AreStoppedAnywhere) {
  const Sampled sphere(quadratic(verification::sphereMesh(25, 8), onSphere(25)));
  for (const double at : {0.05, 0.3, 0.7}) {
    std::stop_source stop;
    Job job;
    job.stop = stop.get_token();
    double last = 0;
    job.progress = [&](Phase phase, double fraction) {
      EXPECT_EQ(phase, Phase::kErrorEstimate);
      EXPECT_GE(fraction, last);
      last = fraction;
      if (fraction >= at) stop.request_stop();
    };
    EXPECT_THROW(sphere.residuals(job), Cancelled) << at;
  }
}

}  // namespace
}  // namespace palpa::bem::test
