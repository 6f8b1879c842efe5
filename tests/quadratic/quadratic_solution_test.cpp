#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "bem/base/error.h"
#include "quadratic_body.h"

namespace palpa::bem::test {
namespace {

using namespace verification;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

std::function<SlotCondition(int)> fixedTags(std::vector<int> fixed) {
  return [fixed = std::move(fixed)](int tag) {
    return std::find(fixed.begin(), fixed.end(), tag) != fixed.end() ? SlotCondition::kFixed
                                                                     : SlotCondition::kTraction;
  };
}

TEST(QuadraticSolution, LinearFieldsOnABoxAreExact) {
  // So few elements that no integral is interpolated.
  for (const auto& fixed : {std::vector{4}, {0, 4}, {0, 2, 4}, {0, 1, 2, 3, 5}})
    for (const double nu : {-0.4, 0.3, 0.5}) {
      const Material material{0.1, nu};
      const ExactField exact = linearField(generalGradient(nu == 0.5), {0.1, -0.2, 0.05}, material,
                                           nu == 0.5 ? 4e-4 : 0);
      const QuadraticBody body(
          quadratic(boxMesh({-20, -15, 0}, {20, 15, 20}, 2, 2, 2), onFlatFaces), material, exact,
          fixedTags(fixed));
      EXPECT_LE(body.displacementError(exact), 1e-7) << "nu = " << nu;
      EXPECT_LE(body.maxTractionError(exact), 1e-5) << "nu = " << nu;
    }
}

TEST(QuadraticSolution, InterpolatedKernelsHaveSmallErrors) {
  const Material material{0.1, 0.3};
  const ExactField exact = linearField(generalGradient(false), {0.1, -0.2, 0.05}, material, 0);
  const QuadraticBody body(quadratic(boxMesh({-20, -15, 0}, {20, 15, 20}, 8, 6, 5), onFlatFaces),
                           material, exact, fixedTags({4}));
  EXPECT_LE(body.displacementError(exact), 1e-4);
  EXPECT_LE(body.maxTractionError(exact), 6e-3);
}

TEST(QuadraticSolution, AHangingBarIsExact) {
  // Its displacements are quadratic, its tractions linear.
  const Material material{0.1, 0.4};
  const ExactField exact = hangingBarField({0, 0, -1e-5}, {0, 0, 0}, material);
  // Short enough that no integral is interpolated.
  const QuadraticBody body(quadratic(boxMesh({-5, -6, 0}, {5, 6, 14}, 2, 2, 2), onFlatFaces),
                           material, exact, fixedTags({5}), {1e-8});
  EXPECT_LE(body.displacementError(exact), 1e-6);
  EXPECT_LE(body.maxTractionError(exact), 1e-5);
}

TEST(QuadraticSolution, ConvergesWithOrderThree) {
  for (const double nu : {0.3, 0.5}) {
    const Material material{0.1, nu};
    const ExactField exact = kelvinField({16, -10, 50}, {0.03, -0.02, 0.06}, material);
    double before = 0;
    int nodesBefore = 0;
    for (const int n : {6, 9}) {
      const BoundaryMesh corners =
          retagged(sphereMesh(25, n), 1, [](const Vector3d& x) { return x[2] < -10; });
      const QuadraticBody body(quadratic(corners, onSphere(25)), material, exact, fixedTags({1}));
      const double error = body.displacementError(exact);
      const int nodes = body.on->displacementCount();
      const double order = before > 0 ? observedOrder(before, nodesBefore, error, nodes) : 0;
      std::printf("sphere nu %.1f  n %5d  u %.2e  p %.2e  order %.2f\n", nu, nodes, error,
                  body.maxTractionError(exact), order);
      if (n > 6) {
        EXPECT_GE(order, 2.65);
        EXPECT_LE(error, 3e-4);
      }
      before = error;
      nodesBefore = nodes;
    }
  }
}

TEST(QuadraticSolution, SharpEdgesKeepTheOrder) {
  const Material material{0.1, 0.3};
  const ExactField exact = kelvinField({40, 24, 60}, {0.03, -0.02, 0.06}, material);
  double before = 0;
  int nodesBefore = 0;
  for (const int around : {16, 24, 32}) {
    const QuadraticBody body(quadratic(cylinderMesh(20, 60, around, around / 2), onCylinder(20)),
                             material, exact, fixedTags({1, 2}));
    const double error = body.displacementError(exact);
    const int nodes = body.on->displacementCount();
    const double order = before > 0 ? observedOrder(before, nodesBefore, error, nodes) : 0;
    std::printf("cylinder n %5d  u %.2e  p %.2e  order %.2f\n", nodes, error,
                body.maxTractionError(exact), order);
    if (around == 32) {
      EXPECT_GE(order, 2.8);
    }
    before = error;
    nodesBefore = nodes;
  }
}

TEST(QuadraticSolution, InteriorStatesAndStressFollowTheField) {
  const Material material{0.1, 0.45};
  const ExactField exact = kelvinField({16, -10, 50}, {0.03, -0.02, 0.06}, material);
  const BoundaryMesh corners =
      retagged(sphereMesh(25, 6), 1, [](const Vector3d& x) { return x[2] < -10; });
  const QuadraticBody body(quadratic(corners, onSphere(25)), material, exact, fixedTags({1}));
  const VectorXd u = body.field.u.col(0), p = body.field.p.col(0);
  const std::vector<Vector3d> points{{0, 0, 0}, {3, -4, 18}, {10, 15, 3}, {2, -1, 24.5}};
  const auto states =
      body.on->makeInteriorEvaluator(points, material, Job{})->evaluate(u, p, Job{});
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Matrix3d stress = exact.stress(points[k]);
    EXPECT_LE((states[k].displacement - exact.displacement(points[k])).norm(),
              2e-3 * exact.displacement(points[k]).norm());
    EXPECT_LE((states[k].stress - stress).norm(), 3e-2 * stress.norm());
    const auto alone = body.on->interiorState(u, p, material, points[k]);
    ASSERT_TRUE(alone);
    EXPECT_LE((alone->stress - states[k].stress).norm(), 1e-3 * stress.norm());
  }
  EXPECT_FALSE(body.on->interiorState(u, p, material, {0, 0, 26}));
  const auto surfaceStress = body.on->surfaceStress(u, p, material);
  double worst = 0, largest = 0;
  for (int s = 0; s < body.on->slots().count(); ++s) {
    const Matrix3d stress = exact.stress(body.on->places()[body.on->slots().slots[s].node]);
    worst = std::max(worst, (surfaceStress[s] - stress).norm());
    largest = std::max(largest, stress.norm());
  }
  std::printf("surface stress: largest error %.1e\n", worst / largest);
  EXPECT_LE(worst, 0.08 * largest);
}

TEST(QuadraticSolution, EstimatedErrorIsOfTheSizeOfTheError) {
  const Material material{0.1, 0.3};
  const ExactField exact = kelvinField({8, -5, 38}, {0.03, -0.02, 0.06}, material);
  for (const int n : {3, 5}) {
    const BoundaryMesh corners =
        retagged(sphereMesh(25, n), 1, [](const Vector3d& x) { return x[2] < -10; });
    const QuadraticBody body(quadratic(corners, onSphere(25)), material, exact, fixedTags({1}));
    const VectorXd u = body.field.u.col(0), p = body.field.p.col(0);
    const VectorXd carried =
        body.on->estimatedError(*body.problem, body.field, material, Job{}).u.col(0);
    double error = 0, estimate = 0;
    for (int t = 0; t < body.on->mesh().triangleCount(); t += 3) {
      const Vector3d weights(0.5, 0.3, 0.2);
      const SurfacePoint at{t, weights, body.on->mesh().point(t, weights), 0};
      const Vector3d y = body.on->surface().evaluate(QuadraticSurface::place(t, weights)).position;
      error += (exact.displacement(y) - body.on->interpolate(at, u)).squaredNorm();
      estimate +=
          (body.on->interpolate(at, carried) + body.on->displacementDefect(at, u, p, material))
              .squaredNorm();
    }
    std::printf("n %d: estimate over error %.2f\n", body.on->displacementCount(),
                std::sqrt(estimate / error));
    EXPECT_GE(std::sqrt(estimate / error), 0.5);
    EXPECT_LE(std::sqrt(estimate / error), 3.0);
  }
}

TEST(QuadraticSolution, VolumeAreaAndResultantsAreThoseOfTheCurvedSurface) {
  const auto sphere = quadratic(sphereMesh(25, 8), onSphere(25));
  const double volume = 4.0 / 3 * std::numbers::pi * std::pow(25, 3);
  EXPECT_NEAR(sphere->volumeMoments().volume(), volume, 1e-4 * volume);
  double area = 0;
  for (int k = 0; k < sphere->displacementCount(); ++k) area += sphere->area(k);
  EXPECT_NEAR(area, 4 * std::numbers::pi * 625, 1e-4 * 4 * std::numbers::pi * 625);
  std::vector<int> all(static_cast<std::size_t>(sphere->elementCount()));
  std::iota(all.begin(), all.end(), 0);
  const VectorXd pressure = sphere->integrals().projectTraction(
      all, [](const Vector3d&, const Vector3d& n) { return Vector3d(-0.01 * n); }, 1e9);
  const Resultant sum = sphere->resultant(pressure, all);
  EXPECT_LE(sum.force.norm(), 1e-6 * 0.01 * area);
}

TEST(QuadraticSolution, AnUpdateEqualsARebuild) {
  const Material material{0.1, 0.45};
  const auto isFixed = [](const Vector3d& x) { return x.z() < -15; };
  BoundaryMesh corners = retagged(sphereMesh(25, 5), 1, isFixed);
  const auto before = quadratic(corners, onSphere(25));
  BoundaryMesh bulged = before->mesh();
  for (Vector3d& x : bulged.nodes)
    if (x.z() > 22) x.z() += 0.15 * (x.z() - 22);
  const QuadraticDiscretisation after(bulged);
  std::vector<SlotCondition> conditions;
  for (const auto& slot : before->slots().slots) conditions.push_back(fixedTags({1})(slot.tag));
  const ProblemInputs inputs{conditions, material, {1e-6}, Precision::kDouble};
  EXPECT_LE(updateError(*before, after, inputs), 1e-5);
  // A changed topology is no update.
  const auto other = quadratic(sphereMesh(25, 4), onSphere(25));
  EXPECT_TRUE(std::isinf(updateError(*before, *other, inputs)));
}

TEST(QuadraticSolution, APlateThatBecomesThinIsRebuilt) {
  // Its elements have other equations then.
  const auto before = quadratic(boxMesh({0, 0, 0}, {40, 40, 20}, 6, 6, 3), onFlatFaces, {4});
  const auto errorOfDent = [&](double depth) {
    BoundaryMesh dented = before->mesh();
    for (Vector3d& x : dented.nodes) {
      const double distance = (x - Vector3d(20, 20, 20)).norm() / 8;
      if (distance < 1) x.z() -= depth * std::pow(1 - distance * distance, 2);
    }
    std::vector<SlotCondition> conditions;
    for (const auto& slot : before->slots().slots) conditions.push_back(fixedTags({4})(slot.tag));
    return updateError(*before, QuadraticDiscretisation(dented, {4}),
                       {conditions, {0.1, 0.45}, {1e-6}, Precision::kSingle});
  };
  EXPECT_LE(errorOfDent(0.5), 1e-4);
  EXPECT_TRUE(std::isinf(errorOfDent(8)));
}

TEST(QuadraticSurface, RefusesFoldedElements) {
  EXPECT_THROW(quadratic(boxMesh({0, 0, 0}, {1, 1, 1}, 1, 1, 1),
                         [](const Vector3d& a, const Vector3d& b, double) {
                           const Vector3d middle = (a + b) / 2;
                           return middle.z() > 0.9 ? Vector3d(middle + Vector3d(0.45, 0.1, 0))
                                                   : middle;
                         }),
               SolverError);
}

TEST(QuadraticSurface, PlacesAndQuartersAreInverse) {
  const auto sphere = quadratic(sphereMesh(25, 2), onSphere(25));
  for (int t = 0; t < 8; ++t)
    for (const Vector3d& weights : {Vector3d(0.2, 0.3, 0.5), Vector3d(0.6, 0.3, 0.1)}) {
      const auto [triangle, found] = QuadraticSurface::quarter(QuadraticSurface::place(t, weights));
      EXPECT_EQ(triangle, t);
      EXPECT_LE((found - weights).norm(), 1e-12);
    }
  // A node belongs to all elements around, a point of an edge to two.
  const QuadraticSurface& surface = sphere->surface();
  EXPECT_EQ(surface.placesAt({0, 0.25, 0}).places.size(), 2U);
  for (const ElementPlace& place : surface.placesAt({0, 0.25, 0}).places)
    EXPECT_LE((surface.evaluate(place).position - surface.evaluate({0, 0.25, 0}).position).norm(),
              1e-10);
  EXPECT_EQ(surface.placesAt({0, 0, 0}).places.size(),
            surface.around(surface.coefficients(0)[0]).size());
}

}  // namespace
}  // namespace palpa::bem::test
