// Field of a point force outside the body: smooth and not a polynomial, so the error shows the
// order. Displacements are prescribed on one part of the surface, tractions on the rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/core/setup/to_spline_surface.h"
#include "modeling/shapes/make_primitive.h"
#include "spline_fem.h"
#include "study_solutions.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;

const Material kMaterial{0.1, 0.3};

struct Body {
  const char* name;
  ExactField exact;
  FixedPlaces fixed;
};

StudySeries splineSeries(const Body& body, const char* engine,
                         const std::vector<modeling::Solid>& solids) {
  StudySeries series{body.name, engine, {}};
  for (const modeling::Solid& solid : solids) {
    const auto solved =
        solveSplines(fixedWhere(app::splineSurfaceOf(solid), body.fixed), kMaterial, body.exact);
    series.steps.push_back(stepOf(*solved, body.exact));
  }
  report(series);
  return series;
}

StudySeries triangleSeries(const Body& body, const modeling::Solid& solid,
                           const std::vector<double>& edgeLengths) {
  StudySeries series{body.name, kTriangles, {}};
  for (const double edgeLength : edgeLengths)
    series.steps.push_back(
        stepOf(*solveTriangles(triangleMesh(solid, edgeLength), body.fixed, kMaterial, body.exact),
               body.exact));
  report(series);
  return series;
}

/// Solids of one shape with nets of the given sizes per direction and patch.
template <class Shape>
std::vector<modeling::Solid> withNets(const Shape& shape, int degree,
                                      const std::vector<int>& sizes) {
  std::vector<modeling::Solid> solids;
  for (const int size : sizes) solids.push_back(modeling::makePrimitive({shape, degree, size}));
  return solids;
}

/// Solids with every knot span of one solid subdivided.
std::vector<modeling::Solid> withParts(const modeling::Solid& solid,
                                       const std::vector<int>& parts) {
  std::vector<modeling::Solid> solids;
  for (const int n : parts) solids.push_back(divided(solid, n));
  return solids;
}

struct Engines {
  StudySeries triangles, quadratic, cubic;
};

/// Checks the orders of the last refinement: the best functions of each space reach degree + 1.
void expectOrders(const Engines& engines) {
  EXPECT_NEAR(engines.triangles.lastOrder(), 2, 0.3);
  EXPECT_GE(engines.quadratic.lastOrder(), 3);
  EXPECT_GE(engines.cubic.lastOrder(), 4);
  for (const StudySeries* splines : {&engines.quadratic, &engines.cubic})
    for (const StudyStep& step : splines->steps) EXPECT_LE(step.error, 2 * step.best);
}

double leastError(const StudySeries& series, int mostCoefficients) {
  double least = INFINITY;
  for (const StudyStep& step : series.steps)
    if (step.coefficients <= mostCoefficients) least = std::min(least, step.error);
  return least;
}

/// True in the lowest of the six patches of a sphere.
bool isInLowestPatch(const Vector3d& x) {
  return x.z() < -std::max(std::abs(x.x()), std::abs(x.y()));
}

const modeling::SphereShape kSphere{25};

TEST(SplineStudy, SphereWithASource47mmFromItsMiddle) {
  const Body body{"sphere, source at 47 mm",
                  kelvinField({20, 15, 40}, {0.03, -0.02, 0.06}, kMaterial), isInLowestPatch};
  const auto coarse = modeling::makePrimitive({kSphere, 3, 7});
  const Engines engines{triangleSeries(body, coarse, {9, 6, 4.2, 3, 2.1}),
                        splineSeries(body, kQuadratic, withNets(kSphere, 2, {4, 6, 8, 10, 12})),
                        splineSeries(body, kCubic, withNets(kSphere, 3, {5, 7, 9, 11, 13}))};
  expectOrders(engines);
  EXPECT_LE(leastError(engines.cubic, 400), 5e-4);
  EXPECT_LE(leastError(engines.cubic, 620), 1.5e-4);
}

TEST(SplineStudy, SphereWithASource36mmFromItsMiddle) {
  const Body body{"sphere, source at 36 mm",
                  kelvinField({12, 16, 30}, {0.02, -0.03, 0.05}, kMaterial), isInLowestPatch};
  const auto coarse = modeling::makePrimitive({kSphere, 3, 7});
  const Engines engines{triangleSeries(body, coarse, {9, 6, 4.2, 3, 2.1}),
                        splineSeries(body, kQuadratic, withNets(kSphere, 2, {4, 6, 8, 10, 12})),
                        splineSeries(body, kCubic, withNets(kSphere, 3, {5, 7, 9, 11, 13}))};
  expectOrders(engines);
}

TEST(SplineStudy, Cylinder) {
  const Body body{"cylinder", kelvinField({35, 10, 40}, {0.03, 0.02, -0.05}, kMaterial),
                  [](const Vector3d& x) { return x.z() < 1e-6 || x.z() > 60 - 1e-6; }};
  const modeling::CylinderShape shape{20, 60};
  // Twice as many spans along the axis as around a quarter, so that elements are approximately
  // square.
  const auto squared = [&](int degree) {
    return withKnots(modeling::makePrimitive({shape, degree, degree + 2}), "side_xmax", 1,
                     {0.25, 0.75});
  };
  const Engines engines{triangleSeries(body, squared(3), {9, 6, 4.5, 3.4, 2.6}),
                        splineSeries(body, kQuadratic, withParts(squared(2), {1, 2, 3, 4})),
                        splineSeries(body, kCubic, withParts(squared(3), {1, 2, 3, 4}))};
  expectOrders(engines);
}

TEST(SplineStudy, Box) {
  const Body body{"box", kelvinField({10, 5, 35}, {0.03, -0.02, 0.06}, kMaterial),
                  [](const Vector3d& x) { return x.z() < 1e-6; }};
  const modeling::BoxShape shape{{40, 30, 20}};
  const Engines engines{
      triangleSeries(body, modeling::makePrimitive({shape, 3, 4}), {7, 5, 3.5, 2.6, 1.9}),
      splineSeries(body, kQuadratic, withNets(shape, 2, {4, 6, 8, 10, 12})),
      splineSeries(body, kCubic, withNets(shape, 3, {5, 7, 9, 11, 13}))};
  expectOrders(engines);
}

TEST(SplineStudy, Torus) {
  const Body body{"torus", kelvinField({3, -2, 6}, {0.04, 0.03, 0.05}, kMaterial),
                  [](const Vector3d& x) { return x.z() < -7; }};
  const modeling::TorusShape shape{30, 10};
  const Engines engines{
      triangleSeries(body, modeling::makePrimitive({shape, 3, 7}), {5.2, 3.92, 3.13, 2.6}),
      splineSeries(body, kQuadratic, withNets(shape, 2, {4, 5, 6, 7})),
      splineSeries(body, kCubic, withNets(shape, 3, {4, 5, 6, 7, 8}))};
  expectOrders(engines);
}

}  // namespace
}  // namespace palpa::bem::test
