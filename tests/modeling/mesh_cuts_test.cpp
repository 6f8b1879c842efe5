#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <random>

#include "mesh_checks.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/shapes/primitives.h"
#include "modeling/solid/surface_evaluator.h"

// Half spaces in arbitrary position, especially those whose border meets the mesh in a special way.
namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Mesh of a solid cut by one half space; none if it is refused with the region's name.
std::optional<SurfaceMesh> cut(const Solid& solid, double h, const HalfSpace& half) {
  MeshSettings settings;
  settings.edgeLength = h;
  const std::vector<MeshRegion> regions{{"base", Region{{half}}, true}};
  try {
    return mesh(solid, settings, regions);
  } catch (const ModelingError& error) {
    EXPECT_EQ(
        std::string(error.what()).rfind("base: the region contains no part of the surface", 0), 0U)
        << error.what();
    return std::nullopt;
  }
}

/// The surface as small flat pieces, independent of any mesh.
struct Samples {
  explicit Samples(const Solid& solid) {
    constexpr int kPieces = 100;
    const SurfaceEvaluator surface(solid);
    for (int p = 0; p < surface.patchCount(); ++p) {
      const auto [uLow, uHigh] = surface.range(p, 0);
      const auto [vLow, vHigh] = surface.range(p, 1);
      const double du = (uHigh - uLow) / kPieces;
      const double dv = (vHigh - vLow) / kPieces;
      for (int i = 0; i < kPieces; ++i)
        for (int j = 0; j < kPieces; ++j) {
          const SurfacePoint at = surface.evaluate(p, uLow + (i + 0.5) * du, vLow + (j + 0.5) * dv);
          points.push_back(at.position);
          areas.push_back(at.du.cross(at.dv).norm() * du * dv);
        }
    }
  }

  /// Area deeper in the half space than `depth`; a negative depth also counts area just outside.
  double areaIn(const HalfSpace& half, double depth) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (half.value(points[i]) < -depth) sum += areas[i];
    return sum;
  }

  std::array<double, 2> extent(const Vector3d& normal) const {
    std::array<double, 2> range{1e300, -1e300};
    for (const Vector3d& x : points)
      range = {std::min(range[0], normal.dot(x)), std::max(range[1], normal.dot(x))};
    return range;
  }

  std::vector<Vector3d> points;
  std::vector<double> areas;
};

struct Body {
  const char* name;
  Solid solid;
  double border;  // approximate length of the longest border of a half space, mm
};

std::vector<Body> bodies() {
  return {{"sphere", makeSphere(25.0), 160.0},
          {"cylinder", makeCylinder(20.0, 60.0), 190.0},
          {"box", makeBox({40, 30, 20}), 150.0}};
}

/// Returns the smallest angle in degrees; 90 for a region that may be refused and was refused.
double expectTheCut(const Body& body, const Samples& samples, double h, const HalfSpace& half) {
  // A face within rounding of the border may or may not count.
  constexpr double kRounding = 1e-6;
  const double least = samples.areaIn(half, kRounding);
  const double most = samples.areaIn(half, -kRounding);
  const auto result = cut(body.solid, h, half);
  const auto where = [&] {
    return testing::Message() << body.name << " h " << h << " normal " << half.normal.transpose()
                              << " below " << half.below;
  };
  if (!result) {
    EXPECT_LT(least, 0.2 * h * body.border) << where();
    return 90.0;
  }
  EXPECT_EQ(checks::manifoldFault(*result), "") << where();
  // The border may deviate by a fraction of the edge length, and flat triangles lose some area.
  const double whole = checks::totalArea(*result);
  const double tolerance = 0.06 * h * body.border + 0.015 * whole;
  EXPECT_GT(checks::regionArea(*result, 0), least - tolerance) << where();
  EXPECT_LT(checks::regionArea(*result, 0), most + tolerance) << where();
  EXPECT_LT(checks::borderFault(*result, 0, half), 0.14 * h * half.normal.norm()) << where();
  return measureQuality(*result).smallestAngle;
}

TEST(Cuts, TooManyHalfSpacesAreRefused) {
  std::vector<MeshRegion> regions;
  for (int i = 0; i < 65; ++i)
    regions.push_back(
        {"r" + std::to_string(i), Region{{HalfSpace{Vector3d::UnitZ(), 0.1 * i}}}, true});
  MeshSettings settings;
  settings.edgeLength = 5.0;
  try {
    mesh(makeBox({20, 20, 20}), settings, regions);
    FAIL() << "accepted";
  } catch (const ModelingError& error) {
    EXPECT_STREQ(
        error.what(),
        "the regions have 65 different half spaces and paintings; at most 64 are possible: "
        "combine some");
  }
}

TEST(Cuts, Random) {
  for (const Body& body : bodies()) {
    int below15 = 0;
    const Samples samples(body.solid);
    std::mt19937 random(1);
    std::normal_distribution<double> any;
    std::uniform_real_distribution<double> part(0.0, 1.0);
    for (int i = 0; i < 60; ++i) {
      const Vector3d normal = Vector3d(any(random), any(random), any(random)).normalized();
      const auto [low, high] = samples.extent(normal);
      const double h = 3.0 + 5.0 * part(random);
      const double angle =
          expectTheCut(body, samples, h, {normal, low + part(random) * (high - low)});
      EXPECT_GT(angle, 7.0) << body.name << ' ' << i;
      if (angle < 15.0) ++below15;
    }
    EXPECT_LE(below15, 4) << body.name;
  }
}

TEST(Cuts, NearlyParallelToAnAxisAndBesideTheEnds) {
  for (const Body& body : bodies()) {
    const Samples samples(body.solid);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> by(-1.0, 1.0);
    for (int i = 0; i < 16; ++i) {
      Vector3d normal = Vector3d::Zero();
      normal[i % 3] = i % 2 ? 1.0 : -1.0;
      const double tilt = i % 5 == 0 ? 0.0 : std::pow(10.0, -1 - i % 13);
      normal += tilt * Vector3d(by(random), by(random), by(random));
      const auto [low, high] = samples.extent(normal);
      const double inside = std::pow(10.0, -(i % 8));
      for (double below : {low + inside, high - inside, high})
        expectTheCut(body, samples, i % 4 ? 4.3 : 7.9, {normal, below});
    }
  }
}

// Where a plane grazes a surface, its border runs along edges and bulges over some of them.
TEST(Cuts, AGrazedTorusKeepsItsSupport) {
  const palpa::modeling::Body torus = makePrimitive({.shape = TorusShape{30.0, 14.0}});
  const Samples samples(std::get<Solid>(torus));
  for (const Vector3d& down : {Vector3d(0.1298, 0.0501, -0.9903), Vector3d(0.03, -0.08, -0.99),
                               Vector3d(0.0, 0.01, -1.0), Vector3d(-0.2, 0.07, -0.97)})
    for (const double height : {9.0, 10.5, 11.6})
      for (const double h : {5.6, 4.2}) {
        const HalfSpace above{down.normalized(), -height};
        MeshSettings settings;
        settings.edgeLength = h;
        settings.engine = Engine::kQuadratic;
        const std::vector<MeshRegion> regions{{"base", Region{{above}}, true}};
        const double area = checks::regionArea(mesh(torus, settings, regions), 0);
        // The straight sides of the elements inside the curved border lose about 0.5 %.
        EXPECT_GT(area / samples.areaIn(above, 0.0), 0.985)
            << h << ' ' << height << ' ' << down.transpose();
      }
}

TEST(Cuts, ThroughRowsOfNodes) {
  for (const Body& body : bodies()) {
    const Samples samples(body.solid);
    MeshSettings settings;
    settings.edgeLength = 4.3;
    const SurfaceMesh plain = mesh(body.solid, settings);
    std::mt19937 random(3);
    for (int i = 0; i < 40; ++i) {
      Vector3d normal = Vector3d::Zero();
      normal[i % 3] = i % 2 ? 1.0 : -1.0;
      if (i % 4 == 0) normal = Vector3d(1, -1, i % 8 ? 1 : 0).normalized();
      const double through = normal.dot(plain.positions[random() % plain.positions.size()]);
      expectTheCut(body, samples, 4.3, {normal, through + 1e-13 * (i % 5 - 2)});
    }
  }
}

TEST(Cuts, OutsideOrOnlyTouchingAreRefused) {
  const Solid box = makeBox({40, 30, 20});
  for (const Vector3d& normal : {Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(1, 1, 0),
                                 Vector3d(1, 1, 1), Vector3d(-1, 2, 3), Vector3d(0, 1e-7, 1)}) {
    double least = 1e300;
    for (const Vector3d& x : box.controlPoints()) least = std::min(least, normal.dot(x));
    for (double away : {0.0, 1e-12, 1e-3, 1.0, 1e6})
      EXPECT_FALSE(cut(box, 5.0, {normal, least - away})) << normal.transpose() << ' ' << away;
  }
  for (double below : {-25.2, -26.0, -1e9})
    EXPECT_FALSE(cut(makeSphere(25.0), 5.0, {{0, 1, 0}, below}));
}

TEST(Cuts, StripsAreFoundAnywhereBetweenTheNodes) {
  const Solid cylinder = makeCylinder(20.0, 60.0);
  const Solid box = makeBox({40, 30, 20});
  for (double h : {3.0, 7.9})
    for (double wide : {0.25, 0.3, 0.5, 0.7, 1.0, 1.5}) {
      const double half = 0.5 * wide * h;
      for (double angle : {0.0, 0.1, 0.3}) {
        const auto result =
            cut(cylinder, h,
                {{std::cos(angle), std::sin(angle), 0.0}, -std::sqrt(400.0 - half * half)});
        ASSERT_TRUE(result) << h << ' ' << wide << ' ' << angle;
        EXPECT_EQ(checks::manifoldFault(*result), "");
        // Two borders, each with a deviation of at most 0.05 of an edge.
        EXPECT_NEAR(checks::regionArea(*result, 0), 60.0 * 2.0 * half, 60.0 * 0.1 * h)
            << h << ' ' << wide << ' ' << angle;
      }
      const auto result = cut(box, h, {{1.0, 1.0, 0.0}, -35.0 + half});
      ASSERT_TRUE(result) << h << ' ' << wide;
      EXPECT_NEAR(checks::regionArea(*result, 0), 40.0 * half + half * half, 20.0 * 0.1 * h);
    }
}

TEST(Cuts, TheSameInputGivesTheSameBits) {
  const HalfSpace half{Vector3d(0.3, -0.5, 0.8).normalized(), 3.0};
  for (const Body& body : bodies()) {
    const auto one = cut(body.solid, 4.0, half);
    const auto two = cut(body.solid, 4.0, half);
    ASSERT_TRUE(one && two);
    EXPECT_EQ(one->positions, two->positions);
    EXPECT_EQ(one->triangles, two->triangles);
    EXPECT_EQ(one->trianglesOfRegion, two->trianglesOfRegion);
  }
}

}  // namespace
}  // namespace palpa::modeling
