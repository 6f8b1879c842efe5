// Meshes that are finer at the places of touches and small loads.
#include <gtest/gtest.h>

#include "modeling/mesh/mesh.h"
#include "modeling/mesh/mesh_focus.h"
#include "modeling/project/mesh_foci.h"
#include "modeling/shapes/primitives.h"
#include "test_bodies.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Longest edge with an end within a distance of a place, mm.
double longestNear(const SurfaceMesh& mesh, const Vector3d& place, double distance) {
  double longest = 0;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vector3d &a = mesh.positions[t[k]], &b = mesh.positions[t[(k + 1) % 3]];
      if ((a - place).norm() <= distance) longest = std::max(longest, (a - b).norm());
    }
  return longest;
}

MeshSettings settingsOf(Engine engine, double edgeLength) {
  MeshSettings settings;
  settings.engine = engine;
  settings.edgeLength = edgeLength;
  return settings;
}

class MeshFoci : public testing::TestWithParam<Engine> {};

TEST_P(MeshFoci, MakeTheMeshFineAroundAPlaceAlone) {
  const MeshFocus focus{{25, 0, 0}, 6, 1};
  const MeshSettings settings = settingsOf(GetParam(), 5);
  for (const Body& body : {Body(makeSphere(25)), Body(test::bodyOf(makeSphere(25), 1))}) {
    const SurfaceMesh plain = mesh(body, settings),
                      fine = mesh(body, settings, {}, {}, {&focus, 1});
    EXPECT_GE(longestNear(plain, focus.center, 5), 3);
    EXPECT_LE(longestNear(fine, focus.center, 3), 2.3);
    EXPECT_GE(longestNear(fine, {-25, 0, 0}, 5), 3);
    const auto added = static_cast<double>(fine.positions.size() - plain.positions.size());
    const double estimated =
        estimateNodeCount(body, settings, {}, {&focus, 1}) - estimateNodeCount(body, settings);
    EXPECT_GT(added, 40);
    EXPECT_LE(added, 2.5 * estimated);
    EXPECT_GE(added, 0.4 * estimated);
  }
}

TEST_P(MeshFoci, OfCoarserLengthsChangeNothing) {
  const MeshFocus focus{{25, 0, 0}, 20, 8};
  const MeshSettings settings = settingsOf(GetParam(), 4);
  const Body body(makeSphere(25));
  EXPECT_EQ(mesh(body, settings, {}, {}, {&focus, 1}).positions, mesh(body, settings).positions);
}

// With edges of 20 mm no edge comes near a narrow focus.
TEST_P(MeshFoci, InTheMiddleOfALargeTriangleAreFound) {
  const MeshSettings settings = settingsOf(GetParam(), 15);
  const Body body(makeSphere(40));
  const SurfaceMesh coarse = mesh(body, settings);
  for (std::size_t t = 0; t < coarse.triangles.size(); t += 5) {
    const auto& nodes = coarse.triangles[t];
    const Eigen::Vector3d middle =
        coarse.positions[nodes[0]] + coarse.positions[nodes[1]] + coarse.positions[nodes[2]];
    const MeshFocus focus{40 * middle.normalized(), 4, 1};
    EXPECT_LE(longestNear(mesh(body, settings, {}, {}, {&focus, 1}), focus.center, 2), 2.4) << t;
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, MeshFoci, testing::Values(Engine::kTriangles, Engine::kQuadratic),
                         [](const auto& engine) {
                           return engine.param == Engine::kTriangles ? "triangles" : "quadratic";
                         });

TEST(MeshFociOfAProject, AreItsNarrowTouchesAndBumps) {
  Project project;
  project.body = makeSphere(25);
  project.mesh = settingsOf(Engine::kTriangles, 4);
  project.touches.push_back({"wide", {0, 0, 25}, TouchKind::kGrab, {0, 0, -1}, 20.0});
  project.touches.push_back({"narrow", {25, 0, 0}, TouchKind::kGrab, {-1, 0, 0}, 3.0});
  project.touches.push_back({"by default", {0, 25, 0}, TouchKind::kGrab, {0, -1, 0}});
  project.touches.push_back({"ball", {0, 25, 0}, TouchKind::kBall, {0, -1, 0}, 9.0});
  project.loads.push_back({"bump", Bump{{-25, 0, 0}, 2, 0.01, {1, 0, 0}}});
  const auto foci = meshFoci(project);
  ASSERT_EQ(foci.size(), 3U);
  EXPECT_EQ(foci[0].center, Vector3d(25, 0, 0));
  EXPECT_LT(foci[0].edgeLength, 1.5);
  EXPECT_DOUBLE_EQ(foci[1].radius, 3);  // sqrt(9 * 1)
  EXPECT_EQ(foci[2].radius, 2);
  project.mesh.engine = Engine::kSplines;
  EXPECT_TRUE(meshFoci(project).empty());
}

// Their pins could be left out by the mesh.
TEST(MeshFociOfAProject, AreAllTouchesOfAMeshBody) {
  Project project;
  project.body = test::icosphere(25, 2);
  project.mesh = settingsOf(Engine::kTriangles, 4);
  project.touches.push_back({"wide", {0, 0, 25}, TouchKind::kGrab, {0, 0, -1}, 20.0});
  project.touches.push_back({"by default", {0, 25, 0}, TouchKind::kGrab, {0, -1, 0}});
  const auto foci = meshFoci(project);
  ASSERT_EQ(foci.size(), 2U);
  EXPECT_EQ(foci[0], (MeshFocus{{0, 0, 25}, 4, 4}));
  EXPECT_EQ(foci[1], (MeshFocus{{0, 25, 0}, 4, 4}));
}

}  // namespace
}  // namespace palpa::modeling
