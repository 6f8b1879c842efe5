#include <gtest/gtest.h>

#include <cmath>

#include "app/core/setup/to_spline_surface.h"
#include "bem/base/gauss_rule.h"
#include "bem/spline/spline_collocation.h"
#include "modeling/shapes/primitives.h"
#include "modeling/solid/basis.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

TEST(BsplineBasis, AgreesWithOpenCascade) {
  const std::vector<std::vector<double>> inner{{}, {0.5}, {0.2, 0.2, 0.9}, {0.1, 0.4, 0.4, 0.7}};
  for (int degree = 2; degree <= 5; ++degree)
    for (const auto& list : inner) {
      std::vector<double> knots(degree + 1, -0.3);
      knots.insert(knots.end(), list.begin(), list.end());
      knots.insert(knots.end(), degree + 1, 1.6);
      const BsplineBasis basis(degree, knots);
      ASSERT_EQ(basis.count(), degree + 1 + static_cast<int>(list.size()));
      for (int f = 0; f < basis.count(); ++f)
        EXPECT_NEAR(basis.greville(f), modeling::greville(knots, degree, f), 1e-15);
      for (std::size_t s = 0; s < basis.spans().size(); ++s) {
        const BsplineBasis::Span& span = basis.spans()[s];
        for (const double fraction : {0.01, 0.3, 0.77}) {
          const double t = span.lower + fraction * (span.upper - span.lower);
          const modeling::BasisFunctions expected = modeling::basisAt(knots, degree, t);
          double value[6], slope[6];
          basis.evaluate(static_cast<int>(s), t, value, slope);
          ASSERT_EQ(span.first, expected.first);
          for (int k = 0; k <= degree; ++k) {
            EXPECT_NEAR(value[k], expected.value[k], 1e-13);
            EXPECT_NEAR(slope[k], expected.derivative[k], 1e-11);
          }
        }
      }
    }
}

TEST(BsplineBasis, RefusesKnotsThatDoNotFit) {
  EXPECT_THROW(BsplineBasis(3, {0, 0, 0, 1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(BsplineBasis(6, std::vector<double>(14, 0.0)), std::invalid_argument);
  EXPECT_THROW(BsplineBasis(1, {2, 2, 2, 2}), std::invalid_argument);
}

TEST(GaussRule, IntegratesPolynomialsOfDegreeTwiceItsPointsLessOne) {
  for (int n = 1; n <= kMaxGaussPoints; ++n) {
    const GaussRule& rule = gaussRule(n);
    for (int power = 0; power <= 2 * n; ++power) {
      double sum = 0;
      for (int k = 0; k < n; ++k) sum += rule.weights[k] * std::pow(rule.points[k], power);
      const double error = std::abs(sum - 1.0 / (power + 1));
      if (power < 2 * n) {
        EXPECT_LT(error, 1e-14) << n << " points, power " << power;
      } else if (n < 12) {
        EXPECT_GT(error, 1e-16) << "a rule of " << n << " points cannot do that";
      }
    }
  }
  EXPECT_THROW(gaussRule(0), std::out_of_range);
  EXPECT_THROW(gaussRule(kMaxGaussPoints + 1), std::out_of_range);
}

TEST(SplineSurface, IsTheSolid) {
  const modeling::Solid solid = modeling::makeCylinder(20, 60);
  const modeling::SurfaceEvaluator exact(solid);
  const SplineSurface surface = app::splineSurfaceOf(solid);
  EXPECT_EQ(surface.closedSurfaceCount(), 1);
  for (int e = 0; e < surface.elementCount(); ++e) {
    const SplineElement& element = surface.elements()[e];
    const double u = element.lower[0] + 0.3 * (element.upper[0] - element.lower[0]);
    const double v = element.lower[1] + 0.8 * (element.upper[1] - element.lower[1]);
    const SurfaceJet jet = surface.evaluate({e, u, v});
    const modeling::SurfacePoint expected = exact.evaluate(element.patch, u, v);
    EXPECT_LT((jet.position - expected.position).norm(), 1e-11);
    EXPECT_LT((jet.du - expected.du).norm(), 1e-9);
    EXPECT_LT((jet.dv - expected.dv).norm(), 1e-9);
    EXPECT_GT(surface.normal({e, u, v}).dot(exact.normal(element.patch, u, v)), 1 - 1e-12);
    std::vector<double> basis;
    surface.evaluateBasis({e, u, v}, basis);
    double sum = 0;
    for (const double value : basis) sum += value;
    EXPECT_NEAR(sum, 1, 1e-13);
  }
}

TEST(SplineTractions, SplitAtSharpEdgesAndBordersOfTagsOnly) {
  // A sphere has one face, a box three slots in each corner, two on each edge.
  const SplineSurface sphere = app::splineSurfaceOf(modeling::makeSphere(25));
  EXPECT_EQ(SplineTractions(sphere).slots.count(), sphere.coefficientCount());
  SplineSurface box = app::splineSurfaceOf(modeling::makeBox({40, 30, 20}));
  const SplineTractions split(box);
  ASSERT_EQ(box.coefficientCount(), 56);  // 4 x 4 on each of six faces
  EXPECT_EQ(split.slots.count(), 6 * 16);
  for (const auto& slot : split.slots.slots)
    EXPECT_NEAR(slot.normal.cwiseAbs().maxCoeff(), 1, 1e-12) << "not a normal of a face";
}

TEST(SplineCollocation, PointsBelongToAllElementsThatContainThem) {
  const SplineSurface surface = app::splineSurfaceOf(modeling::makeCylinder(20, 60));
  const auto points = grevilleCollocation(surface);
  ASSERT_EQ(static_cast<int>(points.size()), surface.coefficientCount());
  for (const CollocationPlace& point : points) {
    for (const ElementPlace& place : point.places)
      EXPECT_LT((surface.evaluate(place).position - point.position).norm(), 1e-9);
    // No other element touches it.
    for (int e = 0; e < surface.elementCount(); ++e) {
      if (std::any_of(point.places.begin(), point.places.end(),
                      [e](const ElementPlace& p) { return p.element == e; }))
        continue;
      const SplineElement& element = surface.elements()[e];
      for (int i = 0; i <= 6; ++i)
        for (int j = 0; j <= 6; ++j) {
          const ElementPlace place{
              e, element.lower[0] + i / 6.0 * (element.upper[0] - element.lower[0]),
              element.lower[1] + j / 6.0 * (element.upper[1] - element.lower[1])};
          EXPECT_GT((surface.evaluate(place).position - point.position).norm(), 1e-6);
        }
    }
  }
}

TEST(SplineCollocation, FurtherPointsLieInsideTheFaceTheyStandFor) {
  SplineSurface box = app::splineSurfaceOf(modeling::makeBox({40, 30, 20}));
  const SplineTractions tractions(box);
  for (int s = 0; s < tractions.slots.count(); ++s) {
    const auto shifted = shiftedCollocation(box, tractions, s);
    ASSERT_TRUE(shifted);
    const CollocationPlace& point = *shifted;
    int sides = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = axis == 2 ? 0 : axis == 1 ? -15 : -20, high = axis == 2 ? 20 : -low;
      const double x = point.position[axis];
      const bool isOnFace = std::min(std::abs(x - low), std::abs(x - high)) < 1e-9;
      if (isOnFace) ++sides;
      EXPECT_EQ(isOnFace, std::abs(tractions.slots.slots[s].normal[axis]) > 0.5);
    }
    EXPECT_EQ(sides, 1);
  }
}

}  // namespace
}  // namespace palpa::bem
