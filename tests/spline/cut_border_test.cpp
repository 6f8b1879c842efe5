// Weighted and extended functions beside the border of a support that runs through patches.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "app/core/setup/to_spline_surface.h"
#include "bem/spline/spline_collocation.h"
#include "bem/spline/spline_equations.h"
#include "bem/spline/spline_gluing.h"
#include "bem/spline/spline_integrals.h"
#include "bem/spline/spline_results.h"
#include "bem/spline/surface_part.h"
#include "modeling/shapes/primitives.h"
#include "spline_fem.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

SplineSurface heldSphere(const Vector3d& across, double height) {
  const Vector3d axis = across.normalized();
  return withPart(
      app::splineSurfaceOf(modeling::makeSphere(25, 9)),
      [=](const Vector3d& x) { return x.dot(axis) - height; }, 1, Tearing::kRoots);
}

std::vector<SplineSurface> heldSpheres() {
  std::vector<SplineSurface> all;
  for (const Vector3d& across :
       {Vector3d(0, 0, 1), Vector3d(0.3, -0.5, 1), Vector3d(-0.8, 0.1, 0.3)})
    for (const double height : {-23.5, -20.0, -8.0, 3.0}) all.push_back(heldSphere(across, height));
  return all;
}

std::vector<int> allElements(const SplineSurface& surface) {
  std::vector<int> all;
  for (int e = 0; e < surface.elementCount(); ++e) all.push_back(e);
  return all;
}

TEST(CutBorder, TheWeightIsARootWithASmoothEnd) {
  for (const double t : {1e-8, 1e-4})
    EXPECT_NEAR(CutBorder::weight(t) / std::sqrt(4 * t), 1, 2 * t);
  EXPECT_EQ(CutBorder::weight(1), 1);
  EXPECT_EQ(CutBorder::weight(2), 1);
  for (const double t : {0.01, 0.3, 0.8, 0.999}) {
    const double step = 1e-6;
    EXPECT_NEAR(CutBorder::slope(t),
                (CutBorder::weight(t + step) - CutBorder::weight(t - step)) / (2 * step), 1e-6);
  }
}

TEST(CutBorder, MapsWithRootsHaveTheRightDerivatives) {
  CutMap::Values lower{}, upper{};
  for (int k = 0; k < CutMap::kPoints; ++k) {
    lower[k] = 0.1 * CutMap::node(k);
    upper[k] = 1.3 - 0.2 * CutMap::node(k) * CutMap::node(k);
  }
  for (const auto root : {CutMap::Root::kLower, CutMap::Root::kUpper})
    for (const int axis : {0, 1}) {
      const CutMap map(axis, 2, 5, lower, upper, root);
      for (const double s : {0.1, 0.5, 0.9})
        for (const double t : {0.2, 0.7}) {
          const CutMap::Image image = map.at(s, t);
          const double step = 1e-6;
          for (int d = 0; d < 2; ++d) {
            const Eigen::Vector2d by = step * Eigen::Vector2d::Unit(d);
            const Eigen::Vector2d change = (map.at(s + by[0], t + by[1]).parameters -
                                            map.at(s - by[0], t - by[1]).parameters) /
                                           (2 * step);
            EXPECT_LT((change - image.derivative.col(d)).norm(), 1e-8);
          }
          const auto back = map.invert(image.parameters[0], image.parameters[1], 1e-9);
          ASSERT_TRUE(back);
          EXPECT_LT((*back - Eigen::Vector2d(s, t)).norm(), 1e-12);
        }
    }
}

/// One coefficient per control point and one point of collocation for each, on its own side.
TEST(CutBorder, NoCoefficientsAreAdded) {
  for (const SplineSurface& surface : heldSpheres()) {
    EXPECT_EQ(surface.coefficientCount(),
              app::splineSurfaceOf(modeling::makeSphere(25, 9)).coefficientCount());
    const WeightedEquations equations = splineEquations(surface, SplineTractions(surface), {});
    ASSERT_TRUE(equations.isCollocation());
    for (int k = 0; k < surface.coefficientCount(); ++k)
      for (const ElementPlace& place : equations.points[static_cast<std::size_t>(k)].places) {
        EXPECT_EQ(surface.side(place.element), surface.owners()[k]);
        EXPECT_LT((surface.evaluate(place).position -
                   equations.points[static_cast<std::size_t>(k)].position)
                      .norm(),
                  1e-7);
      }
  }
}

/// Two functions with the same point have the same equation. Points were moved along the edge of a
/// patch into its corner, where another function has its point: one of 60 planes.
TEST(CutBorder, PointsOfCollocationDifferAndKeepADistanceFromTheBorder) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-22, 22);
  for (int k = 0; k < 120; ++k) {
    const Vector3d across(normal(random), normal(random), normal(random));
    const SplineSurface surface = heldSphere(across, uniform(random));
    const CutBorder& border = surface.cutBorders().front();
    const auto points = grevilleCollocation(surface);
    for (std::size_t a = 0; a < points.size(); ++a) {
      const Vector3d& at = points[a].position;
      const double inside = surface.owners()[a] == SplineSurface::kFree ? 1 : -1;
      ASSERT_GE(inside * border.level(at), 0.02 * border.width) << k << ", function " << a;
      for (std::size_t b = 0; b < a; ++b)
        ASSERT_GE((points[b].position - at).norm(), 0.1) << k << ", functions " << a << ", " << b;
    }
  }
}

TEST(CutBorder, TranslationsAreExact) {
  std::vector<double> basis;
  for (const SplineSurface& surface : heldSpheres())
    visitSplinePoints(surface, allElements(surface), 3, INFINITY,
                      [&](const ElementPlace& place, const SurfaceJet&, double) {
                        surface.evaluateBasis(place, basis);
                        double sum = 0;
                        for (const double value : basis) sum += value;
                        EXPECT_NEAR(sum, 1, 1e-10);
                      });
}

/// Beside the border, the displacement on the free side tends to that in the support like a root.
TEST(CutBorder, DisplacementsAreContinuousAcrossTheBorder) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> basis;
  for (const SplineSurface& surface : heldSpheres()) {
    VectorXd u(3 * surface.coefficientCount());
    for (double& value : u) value = normal(random);
    int found = 0;
    for (int e = 0; e < surface.elementCount(); ++e) {
      if (!surface.isCut(e) || surface.side(e) != SplineSurface::kFree) continue;
      for (const auto& [s, t] :
           {std::pair(0.4, 0.0), std::pair(0.4, 1.0), std::pair(0.0, 0.6), std::pair(1.0, 0.6)}) {
        const ElementPlace place{e, s, t};
        const Vector3d x = surface.evaluate(place).position;
        if (std::abs(surface.cutBorders()[0].level(x)) > 1e-7) continue;
        const Eigen::Vector2d at = surface.parameters(place).parameters;
        surface.evaluateBasis(e, at, basis);
        const Vector3d free = weightedSum(basis, surface.functions(e), u);
        const SplineElement& element = surface.elements()[e];
        for (const int other :
             surface.elementsAt(element.patch, element.span[0], element.span[1])) {
          if (surface.side(other) != 0) continue;
          surface.evaluateBasis(other, at, basis);
          EXPECT_LT((free - weightedSum(basis, surface.functions(other), u)).norm(), 0.02);
          ++found;
        }
      }
    }
    EXPECT_GT(found, 5);
  }
}

TEST(CutBorder, TangentialSlopesAreDerivatives) {
  const SplineSurface surface = heldSphere({0.3, -0.5, 1}, -8);
  SplineSurface::BasisJet jet;
  std::vector<double> before, after;
  int found = 0;
  for (int e = 0; e < surface.elementCount(); ++e) {
    if (!surface.borderFunctions(e)) continue;
    const SplineElement& element = surface.elements()[e];
    const ElementPlace place{e, element.lower[0] + 0.4 * (element.upper[0] - element.lower[0]),
                             element.lower[1] + 0.6 * (element.upper[1] - element.lower[1])};
    const Eigen::Vector2d at = surface.parameters(place).parameters;
    if (surface.cutBorders()[0].distance(surface.evaluate(place).position) < 0.03) continue;
    surface.evaluateBasis(e, at, jet);
    const double step = 1e-6;
    for (int d = 0; d < 2; ++d) {
      const Eigen::Vector2d by = step * Eigen::Vector2d::Unit(d);
      surface.evaluateBasis(e, at - by, before);
      surface.evaluateBasis(e, at + by, after);
      for (std::size_t f = 0; f < jet.values.size(); ++f)
        EXPECT_NEAR((after[f] - before[f]) / (2 * step), (d == 0 ? jet.du : jet.dv)[f], 2e-4);
    }
    ++found;
  }
  EXPECT_GT(found, 20);
}

/// The displaced body moves as a whole where all coefficients do.
TEST(CutBorder, TheDisplacedNetTakesTranslations) {
  const SplineSurface surface = heldSphere({0.3, -0.5, 1}, -8);
  const Vector3d motion(0.3, -0.1, 0.2);
  VectorXd u(3 * surface.coefficientCount());
  for (int k = 0; k < surface.coefficientCount(); ++k) u.segment<3>(3 * k) = motion;
  const VectorXd glued = gluedCoefficients(surface, u);
  ASSERT_EQ(glued.size(), u.size());
  EXPECT_LT((glued - u).lpNorm<Eigen::Infinity>(), 1e-8);
}

/// Another height of the border changes elements that it does not cut.
TEST(CutBorder, MovedBordersAreSeen) {
  const SplineSurface at = heldSphere({0, 0, 1}, -20), same = heldSphere({0, 0, 1}, -20),
                      higher = heldSphere({0, 0, 1}, -19.99);
  const auto none = at.movedElements(same);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty());
  const auto moved = higher.movedElements(at);
  if (!moved) return;  // functions changed their sides: a full rebuild
  for (int e = 0; e < at.elementCount(); ++e)
    if (at.isWeighted(e)) {
      EXPECT_EQ(std::count(moved->begin(), moved->end(), e), 1) << e;
    }
}

/// Results of integrals over the surface: a body that moves as a whole.
TEST(CutBorder, ResultsOfAMotion) {
  const Material material{0.1, 0.3};
  const SplineSurface surface = heldSphere({0.3, -0.5, 1}, -8);
  const SplineTractions tractions(surface);
  const Vector3d motion(0.3, -0.1, 0.2);
  VectorXd u(3 * surface.coefficientCount());
  for (int k = 0; k < surface.coefficientCount(); ++k) u.segment<3>(3 * k) = motion;
  VectorXd p = VectorXd::Zero(3 * static_cast<Eigen::Index>(tractions.slots.count()));
  const SplineResults results(surface, tractions);
  for (const Vector3d& x : {Vector3d(3, -2, 5), Vector3d(0, 0, -24.8), Vector3d(20, 3, -12)}) {
    const auto state = results.interiorState(u, p, {material, Vector3d::Zero()}, x);
    ASSERT_TRUE(state);
    EXPECT_LT((state->displacement - motion).norm(), 1e-6);
    EXPECT_LT(state->stress.norm(), 1e-6);
  }
  // The work of a support's tractions, and the resultant, by other rules.
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int s = 0; s < tractions.slots.count(); ++s)
    if (tractions.slots.slots[s].tag == 1)
      p.segment<3>(3 * s) = Vector3d(normal(random), normal(random), normal(random));
  const SplineIntegrals integrals(surface, tractions);
  Vector3d force = Vector3d::Zero();
  std::vector<double> basis;
  visitSplinePoints(surface, allElements(surface), 8, INFINITY,
                    [&](const ElementPlace& place, const SurfaceJet&, double area) {
                      surface.evaluateTractionBasis(place, basis);
                      force += area * weightedSum(basis, tractions.ofFunction[place.element], p);
                    });
  const Vector3d found = integrals.resultant(p, allElements(surface)).force;
  EXPECT_LT((found - force).norm(), 1e-3 * force.norm());  // of roots
  EXPECT_NEAR(integrals.strainEnergy(u, p), motion.dot(found) / 2, 1e-9 * found.norm());
}

/// c_sph_equator: the border runs through patches at any place between the knots. Torn functions
/// had 1.4 % (866 coefficients) and 0.9 % (1,178).
TEST(CutBorder, ConvergesOnTheHeldSphere) {
  const auto& reference = femCase("c_sph_equator");
  const auto solve = [&](int points) {
    const FemSolution solution = solveFem(
        reference, fixedSphere(points, {}), [](const Vector3d&) { return Vector3d(0, 0, 0); },
        bumpOf(reference), reference["load"]["a"]);
    std::printf("%d coefficients: u %.2e, energy %.2e, reaction %.2e, %.2f s\n",
                solution.coefficients, solution.errors.anywhere, solution.errors.energy,
                solution.errors.reaction, solution.times.assemble);
    return solution;
  };
  const FemSolution coarse = solve(13), fine = solve(15);
  EXPECT_LE(fine.coefficients, 1200);
  EXPECT_LE(coarse.errors.anywhere, 7e-3);  // of the bump's resolution
  EXPECT_LE(coarse.errors.energy, 2e-3);
  EXPECT_LE(fine.errors.anywhere, 3e-3);
  EXPECT_LE(fine.errors.energy, 1.5e-3);
  EXPECT_LE(fine.errors.reaction, 1e-3);
}

}  // namespace
}  // namespace palpa::bem::test
