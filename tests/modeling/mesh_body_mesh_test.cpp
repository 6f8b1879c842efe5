#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>

#include "mesh_checks.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/nearest_point.h"
#include "modeling/shapes/primitives.h"
#include "test_bodies.h"

namespace palpa::modeling {
namespace {

constexpr double kPi = std::numbers::pi;

SurfaceMesh meshOf(const MeshBody& body, double edgeLength,
                   const std::vector<MeshRegion>& regions = {}) {
  MeshSettings settings;
  settings.edgeLength = edgeLength;
  return mesh(body, settings, regions);
}

NearestOnTriangles surfaceOf(const std::vector<Eigen::Vector3d>& positions,
                             const std::vector<std::array<int, 3>>& triangles) {
  std::vector<std::array<Eigen::Vector3d, 3>> corners;
  for (const auto& [a, b, c] : triangles)
    corners.push_back({positions[a], positions[b], positions[c]});
  return NearestOnTriangles(corners);
}

/// Largest distance of a node of the mesh from the body.
double deviation(const SurfaceMesh& mesh, const MeshBody& body) {
  const NearestOnTriangles surface = surfaceOf(body.positions(), body.triangles());
  double worst = 0.0;
  for (const Eigen::Vector3d& p : mesh.positions)
    worst = std::max(worst, (surface.nearest(p) - p).norm());
  return worst;
}

/// Largest distance of a vertex of the body from the mesh.
double lostDetail(const SurfaceMesh& mesh, const MeshBody& body) {
  const NearestOnTriangles surface = surfaceOf(mesh.positions, mesh.triangles);
  double worst = 0.0;
  for (const Eigen::Vector3d& p : body.positions())
    worst = std::max(worst, (surface.nearest(p) - p).norm());
  return worst;
}

/// Euler characteristic; also checks the other conditions of a closed surface.
int euler(const SurfaceMesh& mesh) {
  const std::string fault = checks::manifoldFault(mesh);
  if (fault.empty()) return 2;
  EXPECT_EQ(fault.rfind("Euler characteristic ", 0), 0U) << fault;
  return std::stoi(fault.substr(21));
}

TEST(MeshBodyMesh, ShapesKeepTheirSurfaceAndGetGoodTriangles) {
  struct Case {
    const char* name;
    MeshBody body;
    int characteristic;
    double angle;
  };
  for (const Case& one :
       {Case{"sphere", test::bodyOf(makeSphere(25), 2), 2, 25.0},
        Case{"cylinder", test::bodyOf(makeCylinder(20, 60), 3), 2, 25.0},
        Case{"box", test::plainBox({40, 30, 20}), 2, 28.0},
        Case{"torus", test::torus(20, 6, 48, 24), 0, 25.0},
        Case{"bored", test::boredCylinder(20, 5, 30, 64), 0, 20.0},
        Case{"hollow", test::hollowSphere(25, 10, 4), 4, 25.0},
        Case{"slivers", test::withSlivers(test::bodyOf(makeCylinder(20, 60), 3)), 2, 25.0},
        Case{"noisy", test::noisy(test::bodyOf(makeSphere(25), 2), 0.1), 2, 20.0}})
    for (double h : {2.0, 3.5, 6.0}) {
      const SurfaceMesh result = meshOf(one.body, h);
      EXPECT_EQ(euler(result), one.characteristic) << one.name << ' ' << h;
      EXPECT_LT(deviation(result, one.body), 1e-9) << one.name << ' ' << h;
      EXPECT_LT(lostDetail(result, one.body), 0.16 * h) << one.name << ' ' << h;
      const MeshQuality quality = measureQuality(result);
      EXPECT_GT(quality.smallestAngle, one.angle) << one.name << ' ' << h;
      EXPECT_LT(quality.longestEdge, 1.8 * h) << one.name << ' ' << h;
    }
}

TEST(MeshBodyMesh, VolumeConvergesToTheBodyVolume) {
  const MeshBody sphere = test::icosphere(25, 5);
  const auto loss = [&](double h) {
    return 1.0 - checks::enclosedVolume(meshOf(sphere, h)) / volume(sphere);
  };
  EXPECT_NEAR(loss(6.0), loss(3.0) * 4.0, 0.3 * loss(6.0));  // second order
  EXPECT_LT(loss(2.0), 3e-3);
  EXPECT_NEAR(checks::enclosedVolume(meshOf(test::plainBox({40, 30, 20}), 3.0)), 24000.0, 1e-6);
}

TEST(MeshBodyMesh, EdgesHaveTheRequestedLength) {
  const MeshBody sphere = test::icosphere(25, 5);
  for (double h : {2.0, 3.0, 5.0}) {
    MeshSettings settings;
    settings.edgeLength = h;
    const SurfaceMesh result = mesh(sphere, settings);
    EXPECT_NEAR(measureQuality(result).meanEdge, h, 0.07 * h);
    EXPECT_NEAR(static_cast<double>(result.positions.size()), estimateNodeCount(sphere, settings),
                0.15 * static_cast<double>(result.positions.size()));
  }
}

TEST(MeshBodyMesh, FacesAndSmoothingGroupsAreKept) {
  const MeshBody cylinder = test::bodyOf(makeCylinder(20, 60), 4);
  const SurfaceMesh result = meshOf(cylinder, 5.0);
  EXPECT_TRUE(result.parameters.empty());
  const int top = *cylinder.findFace("top");
  double topArea = 0.0;
  std::set<int> topGroups;
  std::set<int> sideGroups;
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    const auto [a, b, c] = result.triangles[t];
    const auto& p = result.positions;
    const bool isTop = p[a].z() > 60 - 1e-9 && p[b].z() > 60 - 1e-9 && p[c].z() > 60 - 1e-9;
    EXPECT_EQ(result.patchOfTriangle[t] == top, isTop);
    const double area = 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm();
    if (isTop) topArea += area;
    const bool isBottom = p[a].z() < 1e-9 && p[b].z() < 1e-9 && p[c].z() < 1e-9;
    if (isTop) topGroups.insert(result.smoothingGroupOfTriangle[t]);
    if (!isTop && !isBottom) sideGroups.insert(result.smoothingGroupOfTriangle[t]);
  }
  EXPECT_NEAR(topArea, kPi * 400.0, 0.03 * kPi * 400.0);
  EXPECT_EQ(topGroups.size(), 1U);
  EXPECT_EQ(sideGroups.size(), 1U);  // four patches, one smooth surface
  EXPECT_NE(*topGroups.begin(), *sideGroups.begin());
}

TEST(MeshBodyMesh, RegionsAreCutExactly) {
  const MeshBody box = test::plainBox({40, 30, 20});
  for (double d : {1.0, 5.0, 9.7, 19.0}) {
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    const SurfaceMesh result = meshOf(box, 4.0, {{"low", Region::below(z, d), true}});
    EXPECT_NEAR(checks::regionArea(result, 0), 1200.0 + 140.0 * d, 1e-6) << d;
    EXPECT_LT(checks::borderFault(result, 0, {z, d}), 1e-9);
    EXPECT_GT(measureQuality(result).smallestAngle, 15.0) << d;
  }
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
  const SurfaceMesh oblique = meshOf(
      box, 4.0,
      {{"low", Region::below(normal, 30.0), true}, {"rest", Region::below(-normal, -30.0), true}});
  EXPECT_NEAR(checks::regionArea(oblique, 0) + checks::regionArea(oblique, 1), 5200.0, 1e-6);
  EXPECT_LT(checks::borderFault(oblique, 0, {normal, 30.0}), 1e-9);
  // A cap has the area 2 π R times its height.
  const MeshBody sphere = test::icosphere(25, 5);
  for (double d : {-24.9, -20.0, 3.0})
    EXPECT_NEAR(
        checks::regionArea(meshOf(sphere, 3.0, {{"cap", Region::below({0, 0, 1}, d), true}}), 0) /
            (50.0 * kPi * (25.0 + d)),
        1.0, d < -24 ? 0.15 : 0.02)
        << d;
}

TEST(MeshBodyMesh, ACutBesideAnEdgeLeavesNoStrip) {
  const MeshBody box = test::plainBox({40, 30, 20});
  const SurfaceMesh result = meshOf(box, 4.0, {{"low", Region::below({0, 0, 1}, 0.1), true}});
  EXPECT_NEAR(checks::regionArea(result, 0), 1200.0, 1e-6);
  EXPECT_GT(measureQuality(result).shortestEdge, 1.0);
  EXPECT_THROW(meshOf(box, 4.0, {{"low", Region::below({0, 0, 1}, 0.0), true}}), ModelingError);
}

TEST(MeshBodyMesh, RegionsOfFacesAndUnions) {
  const MeshBody cylinder = test::bodyOf(makeCylinder(20, 60), 4);
  Region both = Region::ofPatches({"top"});
  both.parts.push_back(HalfSpace{Eigen::Vector3d::UnitZ(), 10.0});
  const SurfaceMesh result = meshOf(cylinder, 4.0, {{"ends", both, true}});
  EXPECT_NEAR(checks::regionArea(result, 0), kPi * (800.0 + 400.0), 0.02 * kPi * 1200.0);
  EXPECT_THROW(meshOf(cylinder, 4.0, {{"x", Region::ofPatches({"nose"}), true}}), ModelingError);
}

TEST(MeshBodyMesh, RefinementShortensTheRequestedEdges) {
  const MeshBody box = test::plainBox({40, 30, 20});
  MeshSettings settings;
  settings.edgeLength = 6.0;
  settings.refinementLevels = 2;
  const std::vector<MeshRegion> regions{{"low", Region::below({0, 0, 1}, 10.0), true}};
  const auto lengthNear = [](const SurfaceMesh& mesh, double z) {
    double sum = 0.0;
    int count = 0;
    for (const auto& n : mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d& a = mesh.positions[n[k]];
        const Eigen::Vector3d& b = mesh.positions[n[(k + 1) % 3]];
        if (std::abs(a.z() - z) > 1e-9 || std::abs(b.z() - z) > 1e-9) continue;
        sum += (a - b).norm();
        ++count;
      }
    return sum / count;
  };
  settings.refineAtBorders = true;
  const SurfaceMesh borders = mesh(box, settings, regions);
  EXPECT_NEAR(lengthNear(borders, 10.0), 1.5, 0.3);
  EXPECT_GT(lengthNear(borders, 0.0), 3.0);
  EXPECT_NEAR(static_cast<double>(borders.positions.size()),
              estimateNodeCount(box, settings, regions), 0.4 * borders.positions.size());
  settings.refineAtBorders = false;
  settings.refineAtSharpEdges = true;
  const SurfaceMesh edges = mesh(box, settings, regions);
  EXPECT_GT(measureQuality(edges).smallestAngle, 20.0);
  EXPECT_GT(edges.positions.size(), 400U);
  EXPECT_NEAR(static_cast<double>(edges.positions.size()),
              estimateNodeCount(box, settings, regions), 0.4 * edges.positions.size());
}

TEST(MeshBodyMesh, SmallHolesAndThinPlatesGetSmallerTriangles) {
  const MeshBody hole = test::boredCylinder(20, 1, 30, 64);
  MeshSettings settings;
  settings.edgeLength = 6.0;
  settings.featureFraction = 0.1;  // the usual fraction makes a prism of the hole
  const SurfaceMesh bored = mesh(hole, settings);
  EXPECT_EQ(euler(bored), 0);
  EXPECT_LT(deviation(bored, hole), 1e-9);
  EXPECT_GT(measureQuality(bored).smallestAngle, 20.0);
  EXPECT_NEAR(checks::enclosedVolume(bored) / volume(hole), 1.0, 0.03);
  const SurfaceMesh plate = meshOf(test::plainBox({40, 40, 1}), 5.0);
  EXPECT_GT(measureQuality(plate).smallestAngle, 18.0);
  EXPECT_NEAR(checks::enclosedVolume(plate), 1600.0, 1e-6);
}

TEST(MeshBodyMesh, IsDeterministic) {
  const MeshBody body = test::noisy(test::boredCylinder(20, 5, 30, 32), 0.05);
  const SurfaceMesh one = meshOf(body, 3.0, {{"low", Region::below({0, 0, 1}, 7), true}});
  const SurfaceMesh two = meshOf(body, 3.0, {{"low", Region::below({0, 0, 1}, 7), true}});
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.triangles, two.triangles);
  EXPECT_EQ(one.trianglesOfRegion, two.trianglesOfRegion);
}

TEST(MeshBodyMesh, NodesWithCloseNumbersAreClose) {
  const SurfaceMesh result = meshOf(test::icosphere(25, 4), 2.0);
  double sum = 0.0;
  for (std::size_t i = 1; i < result.positions.size(); ++i)
    sum += (result.positions[i] - result.positions[i - 1]).norm();
  EXPECT_LT(sum / static_cast<double>(result.positions.size()), 2.5 * 2.0);
}

TEST(MeshBodyMesh, AbsurdEdgeLengthsAreRefused) {
  const MeshBody sphere = test::icosphere(25, 3);
  for (double h : {0.0, -1.0, std::nan("")}) EXPECT_THROW(meshOf(sphere, h), ModelingError);
  for (double h : {1e-3, 1e-300}) {
    try {
      meshOf(sphere, h);
      FAIL();
    } catch (const ModelingError& error) {
      EXPECT_EQ(error.kind(), ModelingError::Kind::kTooLarge) << error.what();
    }
  }
  // Even the coarsest mesh is a closed body.
  const SurfaceMesh coarse = meshOf(sphere, 1e6);
  EXPECT_EQ(euler(coarse), 2);
  EXPECT_GT(checks::enclosedVolume(coarse), 0.6 * volume(sphere));
}

TEST(MeshBodyMesh, CanBeCancelled) {
  std::stop_source stop;
  stop.request_stop();
  Job job;
  job.stop = stop.get_token();
  EXPECT_THROW(mesh(test::icosphere(25, 3), MeshSettings{}, {}, job), Cancelled);
}

}  // namespace
}  // namespace palpa::modeling
