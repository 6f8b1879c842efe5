#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "editing_fixture.h"
#include "mesh_checks.h"
#include "modeling/editing/nearest_on_patches.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/mesh_follow.h"
#include "modeling/mesh/region_border.h"
#include "modeling/solid/surface_evaluator.h"
#include "test_bodies.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

SurfaceMesh painted(const Body& body, double h, std::vector<RegionPart> parts) {
  MeshSettings settings;
  settings.edgeLength = h;
  settings.engine = Engine::kTriangles;
  const std::vector<MeshRegion> regions{{"paint", Region{std::move(parts)}, true}};
  return mesh(body, settings, regions);
}

/// Largest |value| in mm of nodes between the region and the rest.
double borderFault(const SurfaceMesh& mesh) {
  const std::set<int> chosen(mesh.trianglesOfRegion[0].begin(), mesh.trianglesOfRegion[0].end());
  std::vector<int> seen(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int node : mesh.triangles[t]) seen[node] |= chosen.contains(static_cast<int>(t)) ? 1 : 2;
  double worst = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i] == 3) worst = std::max(worst, std::abs(mesh.borders[0].value(mesh.positions[i])));
  return worst;
}

TEST(Painted, DiscOnAPlaneHasItsArea) {
  const Solid box = makeBox({40, 30, 20});
  for (const double h : {4.0, 2.0, 1.0}) {
    const SurfaceMesh result = painted(box, h, {Stroke{{{3, -2, 20}}, 7.0}});
    EXPECT_LT(borderFault(result), 1e-9);
    const double exact = std::numbers::pi * 49.0;
    const double error = std::abs(checks::regionArea(result, 0) / exact - 1.0);
    // A chord c loses (c/r)²/6 of the area; chords are at most the diagonal of a cell.
    EXPECT_LT(error, 2.0 * h * h / 49.0 / 6.0) << h;
  }
}

TEST(Painted, UnionOfStrokesHasNoBordersInside) {
  const SurfaceMesh result =
      painted(makeBox({40, 30, 20}), 1.0,
              {Stroke{{{-10, 0, 20}, {0, 0, 20}}, 5.0}, Stroke{{{0, 0, 20}, {10, 0, 20}}, 5.0}});
  EXPECT_NEAR(checks::regionArea(result, 0), 20 * 10 + std::numbers::pi * 25.0, 2.0);
  EXPECT_EQ(result.borders.size(), 1U);
}

double areaOfDot(const Body& body, double h, const Vector3d& at, double radius) {
  return checks::regionArea(painted(body, h, {Stroke{{at}, radius}}), 0) /
         (std::numbers::pi * radius * radius);
}

TEST(Painted, SmallDotsKeepTheirArea) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Solid box = makeBox({40, 30, 20});
  double worst = 0.0;
  for (const double part : {0.25, 0.4, 0.6, 1.0, 1.5})
    for (int trial = 0; trial < 12; ++trial) {
      const double h = trial % 2 == 0 ? 6.0 : 3.0;
      const double radius = part * h;
      const Vector3d at((18.0 - radius) * unit(random), (13.0 - radius) * unit(random), 20.0);
      const double error = std::abs(areaOfDot(box, h, at, radius) - 1.0);
      EXPECT_LT(error, 0.08) << part << " h at " << at.transpose();
      worst = std::max(worst, error);
    }
  std::printf("largest error of a dot's area: %.1f %%\n", 100.0 * worst);
}

TEST(Painted, SmallDotsOnMeshBodiesKeepTheirArea) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const MeshBody box = test::plainBox({40, 30, 20});
  double worst = 0.0;
  for (const double part : {0.25, 0.5, 1.0, 1.5})
    for (int trial = 0; trial < 4; ++trial) {
      const double h = 5.0;
      const Vector3d at(20.0 + (18.0 - part * h) * unit(random),
                        15.0 + (13.0 - part * h) * unit(random), 20.0);
      const double error = std::abs(areaOfDot(box, h, at, part * h) - 1.0);
      EXPECT_LT(error, 0.1) << part << " h at " << at.transpose();
      worst = std::max(worst, error);
    }
  std::printf("largest error of a dot's area: %.1f %%\n", 100.0 * worst);
}

TEST(Painted, NodesOfThinStrokesAreEstimated) {
  const Solid box = makeBox({40, 30, 20});
  const MeshBody meshBox = test::plainBox({40, 30, 20});
  MeshSettings settings;
  for (const double h : {6.0, 3.0})
    for (const double radius : {0.25 * h, 0.6 * h, 2.0 * h})
      for (const double length : {0.0, 15.0}) {
        settings.edgeLength = h;
        const std::vector<MeshRegion> onSolid{
            {"paint", {{Stroke{{{-length, 1, 20}, {length, -3, 20}}, radius}}}, true}};
        const std::vector<MeshRegion> onMesh{
            {"paint", {{Stroke{{{20 - length, 16, 20}, {20 + length, 12, 20}}, radius}}}, true}};
        const auto count = [&](const auto& body, const auto& regions) {
          return static_cast<double>(mesh(body, settings, regions).positions.size());
        };
        const double solid = estimateNodeCount(box, settings, onSolid) / count(box, onSolid);
        const double body = estimateNodeCount(meshBox, settings, onMesh) / count(meshBox, onMesh);
        std::printf("h %g, radius %g, length %g: %.2f, %.2f\n", h, radius, length, solid, body);
        EXPECT_GT(solid, 1.0 / 1.7);
        EXPECT_LT(solid, 1.7);
        EXPECT_GT(body, 1.0 / 1.7);
        EXPECT_LT(body, 1.7);
      }
}

TEST(Painted, StrokeAwayFromTheSurfaceIsRefused) {
  EXPECT_EQ(faultOf([] {
              painted(makeBox({40, 30, 20}), 3.0, {Stroke{{{0, 0, 30}}, 5.0}});
            }).rfind("paint: the region contains no part of the surface", 0),
            0U);
}

TEST(Painted, MeshBodyIsCutAlongStrokes) {
  const MeshBody box = test::plainBox({40, 30, 20});
  const SurfaceMesh result = painted(box, 1.5, {Stroke{{{20, 15, 20}}, 7.0}});
  EXPECT_EQ(checks::manifoldFault(result), "");
  EXPECT_LT(borderFault(result), 0.05);
  EXPECT_NEAR(checks::regionArea(result, 0), std::numbers::pi * 49.0, 3.0);
}

TEST(Painted, RandomStrokesGiveGoodMeshes) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> angles;
  for (const Solid& solid : {makeSphere(25.0), makeCylinder(20.0, 60.0), makeBox({40, 30, 20})}) {
    const SurfaceEvaluator surface(solid);
    for (int trial = 0; trial < 20; ++trial) {
      const double h = trial % 2 == 0 ? 4.0 : 2.5;
      const int patch =
          std::min(static_cast<int>(unit(random) * surface.patchCount()), surface.patchCount() - 1);
      const auto [uLow, uHigh] = surface.range(patch, 0);
      const auto [vLow, vHigh] = surface.range(patch, 1);
      Stroke stroke{{}, (0.5 + 2.0 * unit(random)) * h};
      const double u = unit(random);
      const double v = unit(random);
      const int count = 1 + static_cast<int>(unit(random) * 12);
      const double turn = 6.0 * unit(random);
      for (int i = 0; i < count; ++i) {
        const double a = std::clamp(u + 0.05 * i * std::cos(turn + 0.2 * i), 0.0, 1.0);
        const double b = std::clamp(v + 0.05 * i * std::sin(turn + 0.2 * i), 0.0, 1.0);
        stroke.points.push_back(
            surface.position(patch, uLow + a * (uHigh - uLow), vLow + b * (vHigh - vLow)));
      }
      const SurfaceMesh result = painted(solid, h, {stroke});
      EXPECT_EQ(checks::manifoldFault(result), "");
      EXPECT_LT(checks::distanceFromSurface(result, solid), 1e-9);
      EXPECT_LT(borderFault(result), 0.25 * h) << trial;
      angles.push_back(measureQuality(result).smallestAngle);
    }
  }
  std::sort(angles.begin(), angles.end());
  RecordProperty("smallestAngle", std::to_string(angles.front()));
  RecordProperty("medianAngle", std::to_string(angles[angles.size() / 2]));
  std::printf("smallest angles: least %.1f, tenth %.1f, median %.1f degrees\n", angles.front(),
              angles[angles.size() / 10], angles[angles.size() / 2]);
  EXPECT_GT(angles.front(), 10.0);
  EXPECT_GT(angles[angles.size() / 2], 20.0);
}

TEST(Painted, NarrowGapsBetweenStrokes) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> angles;
  for (int trial = 0; trial < 200; ++trial) {
    const double h = trial % 2 == 0 ? 4.0 : 2.5;
    const double first = (0.4 + unit(random)) * h;
    const double second = (0.4 + unit(random)) * h;
    const double gap = std::pow(10.0, -2.5 + 2.5 * unit(random)) * h;  // 0.003 h … h
    const double turn = 6.3 * unit(random);
    const double tilt = trial % 3 == 0 ? 0.0 : 0.3 * (unit(random) - 0.5);
    const Vector3d along(std::cos(turn), std::sin(turn), 0.0);
    const Vector3d other(std::cos(turn + tilt), std::sin(turn + tilt), 0.0);
    const Vector3d across = (first + second + gap) * Vector3d(-along.y(), along.x(), 0.0);
    const Vector3d middle(4.0 * unit(random) - 2.0, 4.0 * unit(random) - 2.0, 20.0);
    const SurfaceMesh result =
        painted(makeBox({40, 30, 20}), h,
                {Stroke{{middle, middle + 6.0 * along}, first},
                 Stroke{{middle + across, middle + across + 6.0 * other}, second}});
    EXPECT_EQ(checks::manifoldFault(result), "");
    EXPECT_LT(borderFault(result), 0.25 * h);
    angles.push_back(measureQuality(result).smallestAngle);
  }
  std::sort(angles.begin(), angles.end());
  std::printf("smallest angles: least %.1f, tenth %.1f, median %.1f degrees\n", angles.front(),
              angles[angles.size() / 10], angles[angles.size() / 2]);
  // Of 1000 such pairs 3 had angles below 10 degrees, the smallest 7.5.
  EXPECT_GT(angles.front(), 7.0);
  EXPECT_LE(std::lower_bound(angles.begin(), angles.end(), 10.0) - angles.begin(), 2);
}

TEST(Painted, StrokesStayOnTheSurface) {
  Project project = editingProject(makeSphere(25.0));
  const Stroke before{{{25, 0, 0}, {0, 0, 25.5}}, 2.0};
  project.supports[0].where.parts = {before};
  const auto strokeAfter = [&](const Command& command) {
    return std::get<Stroke>(
        palpa::modeling::apply(command, project).project.supports[0].where.parts[0]);
  };
  // All points: the surface is translated, and the paint as well, on or off the surface.
  MovePoints all{
      {{BoxPoints{Vector3d::Constant(-100), Vector3d::Constant(100)}}}, MoveBy{{1, 2, 3}}, {}};
  const Stroke shifted = strokeAfter(all);
  for (int i : {0, 1})
    EXPECT_LT((shifted.points[i] - before.points[i] - Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_EQ(shifted.radius, before.radius);
  // The upper points only: points that they do not affect keep their bits, the other point stays on
  // top.
  MovePoints top{{{BoxPoints{{-100, -100, 20}, Vector3d::Constant(100)}}}, MoveBy{{0, 0, 4}}, {}};
  const Stroke raised = strokeAfter(top);
  EXPECT_EQ(raised.points[0], before.points[0]);
  EXPECT_GT(raised.points[1].z(), before.points[1].z() + 1.0);
  const Stroke again = strokeAfter(top);
  EXPECT_EQ(raised, again);
}

TEST(Painted, NearestPointsAreFoundAcrossPatchEdges) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const Solid& solid : {makeSphere(25.0), makeBox({40, 30, 20}), makeCylinder(20.0, 60.0)}) {
    NearestOnPatches nearest(solid);
    const SurfaceEvaluator surface(solid);
    std::vector<Vector3d> samples;
    for (int patch = 0; patch < surface.patchCount(); ++patch)
      for (int i = 0; i <= 100; ++i)
        for (int j = 0; j <= 100; ++j) {
          const auto [uLow, uHigh] = surface.range(patch, 0);
          const auto [vLow, vHigh] = surface.range(patch, 1);
          samples.push_back(surface.position(patch, uLow + 0.01 * i * (uHigh - uLow),
                                             vLow + 0.01 * j * (vHigh - vLow)));
        }
    for (int trial = 0; trial < 300; ++trial) {
      const double away = trial % 3 == 0 ? 0.0 : 2.0;
      const Vector3d x = samples[random() % samples.size()] +
                         away * Vector3d(unit(random), unit(random), unit(random));
      Vector3d found = Vector3d::Zero();
      double sum = 0.0;
      for (const auto& [point, weight] : nearest.of(x)) {
        found += weight * solid.controlPoints()[point];
        sum += weight;
      }
      EXPECT_NEAR(sum, 1.0, 1e-12);
      double least = 1e300;
      for (const Vector3d& sample : samples) least = std::min(least, (sample - x).norm());
      EXPECT_LT((found - x).norm(), least + 1e-8) << x.transpose();
    }
  }
}

TEST(Painted, StrokesAreTransformedWithTheBody) {
  Project project = editingProject(makeSphere(25.0));
  project.supports[0].where.parts = {Stroke{{{25, 0, 0}}, 2.0}};
  const auto strokeAfter = [&](const TransformSolid& command) {
    return std::get<Stroke>(
        palpa::modeling::apply(command, project).project.supports[0].where.parts[0]);
  };
  EXPECT_EQ(strokeAfter({Translation{{1, 2, 3}}}), (Stroke{{{26, 2, 3}}, 2.0}));
  EXPECT_EQ(strokeAfter({Scaling{{3, 3, 3}, {0, 0, 0}}}), (Stroke{{{75, 0, 0}}, 6.0}));
  EXPECT_NEAR(strokeAfter({Scaling{{8, 1, 1}, {0, 0, 0}}}).radius, 4.0, 1e-12);
}

TEST(Painted, MeshFollowsWithItsPaint) {
  Project project = editingProject(makeSphere(25.0));
  project.supports = {{"paint", Support::Kind::kFixed, {{Stroke{{{0, 0, 25}}, 10.0}}}, {0, 0, 0}}};
  const Solid& before = solidOf(project);
  const SurfaceMesh meshed = mesh(before, project.mesh, meshRegions(project));
  const Project after =
      palpa::modeling::apply(
          MovePoints{
              {{BoxPoints{{-100, -100, 15}, Vector3d::Constant(100)}}}, MoveBy{{0.3, 0, 0.5}}, {}},
          project)
          .project;
  const FollowResult followed = followSolid(meshed, before, solidOf(after), meshRegions(after));
  ASSERT_TRUE(followed.update) << followed.remeshReason;
  EXPECT_LT(borderFault(followed.update->mesh), 1e-8);
  // Paint that moves over a body at rest updates the mesh or requires a new one.
  Project other = project;
  std::get<Stroke>(other.supports[0].where.parts[0]).points[0] = {0.2, 0, 25};
  const FollowResult slid = followSolid(meshed, before, before, meshRegions(other));
  if (slid.update) {
    EXPECT_LT(borderFault(slid.update->mesh), 1e-8);
  }
  std::get<Stroke>(other.supports[0].where.parts[0]).points[0] = {0, 0, -25};
  EXPECT_FALSE(followSolid(meshed, before, before, meshRegions(other)).update);
}

TEST(Painted, BadStrokesAreNamed) {
  const Body body = makeSphere(25.0);
  const auto fault = [&](const Stroke& stroke) {
    return faultOf([&] { checkRegion({{stroke}}, body, "where"); });
  };
  expectBegins(fault({{}, 1.0}), "where.stroke.points_mm: is empty");
  expectBegins(fault({{{0, 0, 0}, {0, NAN, 0}}, 1.0}), "where.stroke.points_mm[1]: must be finite");
  expectBegins(fault({{{0, 0, 0}}, 0.0}), "where.stroke.radius_mm: 0 must be");
  expectBegins(fault({std::vector<Vector3d>(10'001, Vector3d::Zero()), 1.0}),
               "where.stroke.points_mm: has 10001 points");
}

TEST(Painted, FieldIsADistanceNearBorders) {
  const Body body = makeBox({40, 30, 20});
  const Region region{{Stroke{{{0, 0, 10}}, 5.0}, HalfSpace{{0, 0, 2}, -10.0}}};
  const std::vector<Vector3d> positions{{7, 0, 10}, {0, 0, 10}, {20, 0, -6}, {20, 15, 3}};
  const std::vector<int> patches{5, 5, 1, 1};
  const std::vector<double> field = regionField(region, body, positions, patches);
  EXPECT_DOUBLE_EQ(field[0], 2.0);
  EXPECT_DOUBLE_EQ(field[1], -5.0);
  EXPECT_DOUBLE_EQ(field[2], -1.0);
  EXPECT_DOUBLE_EQ(field[3], 8.0);
  const auto named = regionField(Region::ofPatches({"top"}), body, positions, patches);
  EXPECT_LT(named[0], -50.0);
  EXPECT_GT(named[2], 50.0);
}

TEST(Painted, ValueOfManySegmentsIsTheMinimum) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-10.0, 10.0);
  const auto point = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
  std::vector<Stroke> strokes;
  for (int s = 0; s < 7; ++s) {
    strokes.push_back({{}, 1.0 + s});
    for (int i = 0; i < 5 * s + 1; ++i) strokes.back().points.push_back(point());
  }
  const RegionBorder border(strokes);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d x = 3.0 * point();
    double least = 1e300;
    for (const Stroke& stroke : strokes) least = std::min(least, stroke.value(x));
    EXPECT_DOUBLE_EQ(border.value(x), least);
  }
}

}  // namespace
}  // namespace palpa::modeling
