#include "modeling/mesh/quadratic_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/support_border.h"
#include "mesh_checks.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/mesh_follow.h"
#include "modeling/mesh/nearest_point.h"
#include "modeling/mesh/support_chords.h"
#include "modeling/shapes/primitives.h"
#include "modeling/solid/surface_evaluator.h"
#include "test_bodies.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

MeshSettings settings(double edgeLength) {
  MeshSettings of;
  of.edgeLength = edgeLength;
  of.engine = Engine::kQuadratic;
  return of;
}

/// Calls visit(a, b, middle) with the nodes of every element's edges.
template <class Visit>
void forEdges(const SurfaceMesh& mesh, const Visit& visit) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 4) {
    const auto &first = mesh.triangles[t], &second = mesh.triangles[t + 1],
               &third = mesh.triangles[t + 2];
    visit(first[0], second[1], first[1]);
    visit(second[1], third[2], second[2]);
    visit(third[2], first[0], first[2]);
  }
}

/// Checks that middle nodes lie between their ends, and returns the largest distance of one from
/// the chord over its length.
double largestSagitta(const SurfaceMesh& mesh) {
  double largest = 0;
  forEdges(mesh, [&](int a, int b, int middle) {
    const Vector3d chord = mesh.positions[b] - mesh.positions[a],
                   off = mesh.positions[middle] - (mesh.positions[a] + mesh.positions[b]) / 2;
    // In the middle, or at the quarter at the border of a support.
    const double along = std::abs(off.dot(chord)) / chord.squaredNorm();
    EXPECT_LE(along, 0.28);
    largest = std::max(largest,
                       (off - off.dot(chord) / chord.squaredNorm() * chord).norm() / chord.norm());
  });
  return largest;
}

TEST(QuadraticMesh, NodesLieOnThePatchesAndOnTheBorders) {
  const std::pair<Solid, double> bodies[] = {
      {makeSphere(25), -12.0}, {makeCylinder(20, 60), 17.3}, {makeBox({40, 30, 50}), 20.0}};
  for (const auto& [solid, below] : bodies) {
    const HalfSpace low{Vector3d(0.1, 0.2, 1.0), below};
    const std::vector<MeshRegion> regions{{"base", {{low}}, true}};
    const SurfaceMesh mesh = modeling::mesh(Body(solid), settings(4), regions);
    ASSERT_TRUE(mesh.isQuadratic);
    EXPECT_EQ(mesh.triangles.size() % 4, 0U);
    EXPECT_EQ(checks::manifoldFault(mesh), "");
    const SurfaceEvaluator surface(solid);
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
      const SurfaceParameter& at = mesh.parameters[k];
      EXPECT_LE((surface.position(at.patch, at.u, at.v) - mesh.positions[k]).norm(), 1e-9);
    }
    EXPECT_LE(largestSagitta(mesh), 0.2);
    // Four triangles are on one side of the border, and nodes between both sides on it.
    std::vector<int> sides(mesh.positions.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const int node : mesh.triangles[t]) sides[node] |= mesh.bordersOfTriangle[t] ? 2 : 1;
    int onBorder = 0, all = 0;
    for (std::size_t k = 0; k < sides.size(); ++k)
      if (sides[k] == 3) {
        ++all;
        const double value = mesh.borders.front().value(mesh.positions[k]);
        if (std::abs(value) < 1e-7) ++onBorder;
        // Beside patch edges meshes may leave the border by a tenth of the edge length.
        EXPECT_NEAR(value, 0, 0.8);
      }
    EXPECT_GT(onBorder, 10);
    EXPECT_GE(onBorder, 0.8 * all);
    for (const int t : mesh.trianglesOfRegion.front()) EXPECT_NE(mesh.bordersOfTriangle[t], 0U);
  }
}

TEST(QuadraticMesh, HasAboutTheNodesOfALinearMesh) {
  const Body body(makeSphere(25));
  MeshSettings linear = settings(4);
  linear.engine = Engine::kTriangles;
  const auto nodes = [&](const MeshSettings& of) {
    return static_cast<double>(modeling::mesh(body, of).positions.size());
  };
  EXPECT_NEAR(nodes(settings(4)) / nodes(linear), 1, 0.25);
  EXPECT_NEAR(estimateNodeCount(body, settings(4)) / nodes(settings(4)), 1, 0.1);
}

TEST(QuadraticMesh, MiddleNodesOfMeshBodiesLieOnTheSurfaceAndOnItsSharpEdges) {
  const MeshBody body = test::bodyOf(makeCylinder(20, 60), 1);
  const SurfaceMesh mesh = modeling::mesh(Body(body), settings(5));
  ASSERT_TRUE(mesh.isQuadratic);
  EXPECT_EQ(checks::manifoldFault(mesh), "");
  EXPECT_LE(largestSagitta(mesh), 0.2);
  std::vector<std::array<Vector3d, 3>> triangles;
  for (const auto& [a, b, c] : body.triangles())
    triangles.push_back({body.positions()[a], body.positions()[b], body.positions()[c]});
  const NearestOnTriangles surface(triangles);
  for (const Vector3d& x : mesh.positions) EXPECT_LE((surface.nearest(x) - x).norm(), 1e-9);
  // Nodes in the middle of the rim's edges lie on the body's rim, not on the chord: within the
  // sagitta of the body's own edges of 1 mm.
  const double sagitta = 1.0 / (8 * 20);
  int onRim = 0;
  forEdges(mesh, [&](int a, int b, int middle) {
    const auto isOnRim = [&](int node) {
      const Vector3d& x = mesh.positions[node];
      return (x.z() < 1e-6 || x.z() > 60 - 1e-6) && x.head<2>().norm() > 20 - 2 * sagitta;
    };
    if (!isOnRim(a) || !isOnRim(b) || (mesh.positions[a] - mesh.positions[b]).norm() > 15) return;
    ++onRim;
    EXPECT_NEAR(mesh.positions[middle].head<2>().norm(), 20, 3 * sagitta);
  });
  EXPECT_GT(onRim, 20);
}

TEST(QuadraticMesh, FoldedElementsBecomeStraight) {
  // A spike between the middles of coarse edges: middle nodes on it would fold the elements.
  MeshBody::Data data;
  const MeshBody fine = test::icosphere(10, 4);
  data.positions = fine.positions();
  data.triangles = fine.triangles();
  data.faceOfTriangle = fine.faceOfTriangle();
  data.faceNames = fine.faceNames();
  for (Vector3d& x : data.positions)
    if (const double near = (x.normalized() - Vector3d(0.3, 0.5, 0.8).normalized()).norm();
        near < 0.2)
      x *= 1 + 0.8 * (1 - near / 0.2);
  const MeshBody spiked(data);
  MeshSettings coarse = settings(1);
  coarse.engine = Engine::kTriangles;
  const SurfaceMesh corners = modeling::mesh(Body(fine), [&] {
    MeshSettings of = coarse;
    of.edgeLength = 6;
    return of;
  }());
  const SurfaceMesh mesh = quadraticMesh(corners, Body(spiked));
  EXPECT_EQ(checks::manifoldFault(mesh), "");
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 4) {
    const auto normalOf = [&](std::size_t triangle) {
      const auto& [a, b, c] = mesh.triangles[triangle];
      return Vector3d(
          (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]));
    };
    for (std::size_t q = 1; q < 4; ++q) EXPECT_GT(normalOf(t).dot(normalOf(t + q)), 0);
  }
}

/// Corners of the elements, and which elements are in the first region.
std::pair<std::vector<std::array<int, 3>>, std::vector<bool>> elementsOf(const SurfaceMesh& mesh) {
  std::vector<std::array<int, 3>> corners;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 4)
    corners.push_back({mesh.triangles[t][0], mesh.triangles[t + 1][1], mesh.triangles[t + 2][2]});
  std::vector<bool> isSupported(corners.size(), false);
  for (const int t : mesh.trianglesOfRegion.front()) isSupported[t / 4] = true;
  return {corners, isSupported};
}

TEST(QuadraticMesh, AllVerticesOfSupportBordersCanHaveARoot) {
  Region stroke;
  stroke.parts.push_back(Stroke{{{0, 0, 25}, {9, 0, 23}}, 3.0});
  const std::tuple<const char*, Body, Region> cases[] = {
      {"face of a box", makeBox({40, 30, 50}), {{PatchSet{{"bottom"}}}}},
      {"cut box", makeBox({40, 30, 50}), {{HalfSpace{Vector3d(0.5, 0.4, 1), -7}}}},
      {"cap of a cylinder", makeCylinder(20, 60), {{HalfSpace{Vector3d(0.3, 0.1, 1), 4}}}},
      {"small cap", makeSphere(25), Region::below(Vector3d::UnitZ(), -23.5)},
      {"painted", makeSphere(25), stroke},
      {"mesh body", test::icosphere(25, 4), Region::below(Vector3d(0.1, 0.2, 1), -19)}};
  int halved = 0;
  for (const auto& [name, body, where] : cases)
    for (const double edge : {3.1, 4.0, 5.3, 7.0}) {
      SCOPED_TRACE(testing::Message() << name << ", " << edge << " mm");
      const SurfaceMesh mesh =
          modeling::mesh(body, settings(edge), std::vector{MeshRegion{"base", where, true}});
      EXPECT_EQ(checks::manifoldFault(mesh), "");
      const auto [corners, isSupported] = elementsOf(mesh);
      const auto count = static_cast<int>(mesh.positions.size());
      std::vector<bool> isOnBorder(mesh.positions.size(), false);
      const auto isBorder = supportBorderEdges(corners, isSupported);
      for (std::size_t t = 0; t < corners.size(); ++t)
        for (int k = 0; k < 3; ++k)
          if (isBorder[t][k])
            isOnBorder[corners[t][k]] = isOnBorder[corners[t][(k + 1) % 3]] = true;
      EXPECT_EQ(supportBorderVertices(corners, isSupported, count, {}), isOnBorder);
      // Without the support as such nothing is halved.
      halved += mesh.positions.size() >
                modeling::mesh(body, settings(edge), std::vector{MeshRegion{"base", where, false}})
                    .positions.size();
    }
  EXPECT_GE(halved, 3);
}

/// A prism of 30 x 30 x 20 mm with the section of an L, whose notch is along (10, 10, z).
MeshBody step() {
  const std::vector<Eigen::Vector2d> section{{30, 10}, {10, 10}, {10, 30},
                                             {0, 30},  {0, 0},   {30, 0}};
  MeshBody::Data data;
  for (const double z : {0.0, 20.0})
    for (const Eigen::Vector2d& p : section) data.positions.emplace_back(p.x(), p.y(), z);
  const auto add = [&](int face, std::array<int, 3> corners) {
    data.triangles.push_back(corners);
    data.faceOfTriangle.push_back(face);
  };
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    add(k, {k, next, next + 6});
    add(k, {k, next + 6, k + 6});
  }
  for (const auto& [a, b, c] : {std::array{1, 2, 3}, {1, 3, 4}, {1, 4, 5}, {1, 5, 0}}) {
    add(6, {a, c, b});
    add(7, {a + 6, b + 6, c + 6});
  }
  for (int face = 0; face < 8; ++face) data.faceNames.push_back("face_" + std::to_string(face + 1));
  return MeshBody(std::move(data));
}

TEST(QuadraticMesh, AllVerticesOfANotchHaveARoot) {
  const auto isAtNotch = [](const Vector3d& x) {
    return (x.head<2>() - Eigen::Vector2d(10, 10)).norm() < 1e-9;
  };
  for (const double edge : {2.0, 3.1, 5.0}) {
    SCOPED_TRACE(edge);
    const SurfaceMesh mesh =
        modeling::mesh(Body(step()), settings(edge),
                       std::vector{MeshRegion{"base", {{PatchSet{{"face_5"}}}}, true}});
    EXPECT_EQ(checks::manifoldFault(mesh), "");
    int from = 0;
    forEdges(mesh, [&](int a, int b, int middle) {
      const Vector3d &p = mesh.positions[a], &q = mesh.positions[b];
      if (isAtNotch(p) == isAtNotch(q) || p.y() < 1e-9 || q.y() < 1e-9) return;
      const Vector3d &notch = isAtNotch(p) ? p : q, &other = isAtNotch(p) ? q : p;
      EXPECT_NEAR((mesh.positions[middle] - notch).norm(), 0.25 * (other - notch).norm(), 1e-9);
      ++from;
    });
    EXPECT_GT(from, 10);
  }
}

// All triangles of such a face have their vertices on its border; halves would add hundreds of
// nodes to a part.
TEST(QuadraticMesh, TrianglesAcrossANarrowSupportAreNotHalved) {
  const Body bar = makeBox({60, 4, 8});
  const auto countOf = [&](bool isSupport) {
    return modeling::mesh(bar, settings(2.5),
                          std::vector{MeshRegion{"base", {{PatchSet{{"bottom"}}}}, isSupport}})
        .positions.size();
  };
  EXPECT_LE(countOf(true), countOf(false) + 8);
}

TEST(QuadraticMesh, FollowsTheControlPoints) {
  const HalfSpace low{Vector3d(0.1, 0.2, 1.0), -12.0};
  const std::vector<MeshRegion> regions{{"base", {{low}}, true}};
  const Solid sphere = makeSphere(25);
  const SurfaceMesh before = modeling::mesh(Body(sphere), settings(4), regions);
  std::vector<Vector3d> points = sphere.controlPoints();
  for (Vector3d& x : points)
    if (x.z() > 15) x.z() += 1.5;
  const Solid moved = sphere.withControlPoints(points);
  const FollowResult followed = followSolid(before, sphere, moved, regions);
  ASSERT_TRUE(followed.update) << followed.remeshReason;
  EXPECT_TRUE(followed.update->mesh.isQuadratic);
  EXPECT_FALSE(followed.update->movedNodes.empty());
  const SurfaceEvaluator surface(moved);
  for (std::size_t k = 0; k < before.positions.size(); ++k) {
    const SurfaceParameter& at = followed.update->mesh.parameters[k];
    EXPECT_LE((surface.position(at.patch, at.u, at.v) - followed.update->mesh.positions[k]).norm(),
              1e-9);
  }
}

/// A unit cube whose top, of triangles 0 and 1, is a support: the diagonal 0 - 2 is a chord.
SurfaceMesh cubeWithDiagonal() {
  SurfaceMesh cube;
  cube.positions = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1},
                    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  cube.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 7, 6}, {4, 6, 5}, {0, 4, 5}, {0, 5, 1},
                    {1, 5, 6}, {1, 6, 2}, {2, 6, 7}, {2, 7, 3}, {3, 7, 4}, {3, 4, 0}};
  for (const int face : {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}) {
    cube.patchOfTriangle.push_back(face);
    cube.smoothingGroupOfTriangle.push_back(face);
    cube.bordersOfTriangle.push_back(0);
  }
  return cube;
}

/// All middles at one point.
class MiddlesAt final : public MiddleNodes {
 public:
  explicit MiddlesAt(Vector3d at) : at_(std::move(at)) {}
  MiddleNode of(const ElementEdge&) const override { return {at_}; }

 private:
  Vector3d at_;
};

TEST(QuadraticMesh, AChordIsNotSplitOnTheBorder) {
  // The nearest point of the surface, and where the chord is split.
  const std::vector<std::pair<Vector3d, Vector3d>> cases{
      {{0.5, 0.5, 1.1}, {0.5, 0.5, 1.1}},  // a bulge
      {{0.6, 0.5, 1}, {0.6, 0.5, 1}},      // beside the chord
      {{1, 0.5, 1}, {0.5, 0.5, 1}},        // on the border: a triangle without area
      {{1.2, 0.5, 1}, {0.5, 0.5, 1}}};     // beyond it: a folded one
  for (const auto& [nearest, expected] : cases) {
    SurfaceMesh cube = cubeWithDiagonal();
    std::vector<bool> isSupported(cube.triangles.size(), false);
    isSupported[0] = isSupported[1] = true;
    splitSupportChords(cube, isSupported, MiddlesAt(nearest));
    ASSERT_EQ(cube.positions.size(), 9U);
    EXPECT_EQ(cube.positions.back(), expected);
    EXPECT_GT(measureQuality(cube).smallestAngle, 20);
    EXPECT_EQ(checks::manifoldFault(cube), "");
  }
}

}  // namespace
}  // namespace palpa::modeling
