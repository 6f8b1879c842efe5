#include "modeling/mesh/mesh_follow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "mesh_checks.h"
#include "modeling/mesh/mesh.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

struct Case {
  const char* name;
  Solid solid;
  double edgeLength;
  std::vector<MeshRegion> regions;
};

std::vector<Case> cases() {
  const HalfSpace low{Vector3d(0.1, 0.2, 1.0), -12.0};
  const HalfSpace cylinderLow{Vector3d(0.1, -0.2, 1.0), 17.3};
  const HalfSpace side{Vector3d(1.0, 0.3, 0.0), -9.0};
  return {{"sphere", makeSphere(25.0), 4.0, {{"base", {{low}}, true}}},
          {"cylinder", makeCylinder(20.0, 60.0), 5.0, {{"base", {{cylinderLow}}, true}}},
          {"box",
           makeBox({40, 30, 20}),
           4.0,
           {{"base", {{HalfSpace{Vector3d::UnitZ(), 7.3}}}, true},
            {"side", {{side, PatchSet{{"top"}}}}, true}}}};
}

SurfaceMesh meshOf(const Case& c, const Solid& solid, int levels = 0) {
  MeshSettings settings;
  settings.edgeLength = c.edgeLength;
  settings.refinementLevels = levels;
  settings.refineAtBorders = levels > 0;
  return mesh(solid, settings, c.regions);
}

Solid moved(const Solid& solid, const std::vector<std::pair<int, Vector3d>>& moves) {
  std::vector<Vector3d> points = solid.controlPoints();
  for (const auto& [point, by] : moves) points[point] += by;
  return solid.withControlPoints(std::move(points));
}

std::vector<std::pair<int, Vector3d>> randomMoves(const Solid& solid, std::mt19937& random,
                                                  double size) {
  std::uniform_int_distribution<int> which(0, static_cast<int>(solid.controlPoints().size()) - 1);
  std::uniform_real_distribution<double> by(-size, size);
  std::vector<std::pair<int, Vector3d>> moves(1 + which(random) % 3);
  for (auto& [point, step] : moves) {
    point = which(random);
    step = Vector3d(by(random), by(random), by(random));
  }
  return moves;
}

/// True if a basis function of one of the points is nonzero at (u, v), from the support of basis
/// functions alone: knots[i] < u < knots[i + degree + 1], with closed ends.
bool influenced(const Solid& solid, const SurfaceParameter& at, const std::set<int>& points) {
  const Patch& patch = solid.patches()[at.patch];
  const auto inSupport = [&](int direction, std::size_t i, double t) {
    const auto& knots = patch.knots[direction];
    const double low = knots[i];
    const double high = knots[i + patch.degree[direction] + 1];
    return (t > low || (t == low && low == knots.front())) &&
           (t < high || (t == high && high == knots.back()));
  };
  for (std::size_t i = 0; i < patch.net.size(); ++i)
    for (std::size_t j = 0; j < patch.net[i].size(); ++j)
      if (points.contains(patch.net[i][j]) && inSupport(0, i, at.u) && inSupport(1, j, at.v))
        return true;
  return false;
}

double largestBorderFault(const SurfaceMesh& mesh, const SurfaceMesh& reference) {
  double worst = 0.0;
  for (std::size_t k = 0; k < mesh.borders.size(); ++k) {
    std::vector<int> seen(mesh.positions.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int node : mesh.triangles[t])
        seen[node] |= ((mesh.bordersOfTriangle[t] >> k) & 1) ? 1 : 2;
    const RegionBorder& border = mesh.borders[k];
    for (std::size_t i = 0; i < seen.size(); ++i)
      // Corners and nodes between two borders only need to lie on the border.
      if (seen[i] == 3 && std::abs(border.value(reference.positions[i])) < 1e-9)
        worst = std::max(worst, std::abs(border.value(mesh.positions[i])));
  }
  return worst;
}

TEST(Follow, RandomMovesKeepTrianglesSurfaceAndBorders) {
  std::mt19937 random(7);
  int updates = 0;
  int trials = 0;
  for (const Case& c : cases())
    for (int levels : {0, 2}) {
      const SurfaceMesh base = meshOf(c, c.solid, levels);
      for (int trial = 0; trial < 25; ++trial, ++trials) {
        const auto moves = randomMoves(c.solid, random, 2.0);
        const Solid solid = moved(c.solid, moves);
        const FollowResult result = followSolid(base, c.solid, solid, c.regions);
        EXPECT_EQ(result.update.has_value(), result.remeshReason.empty());
        if (!result.update) continue;
        ++updates;
        const SurfaceMesh& followed = result.update->mesh;
        EXPECT_EQ(followed.triangles, base.triangles);
        EXPECT_EQ(followed.trianglesOfRegion, base.trianglesOfRegion);
        EXPECT_LT(checks::distanceFromSurface(followed, solid), 1e-12) << c.name;
        EXPECT_LT(largestBorderFault(followed, base), 1e-9) << c.name;

        std::set<int> points;
        for (const auto& [point, by] : moves) points.insert(point);
        const std::set<int> listed(result.update->movedNodes.begin(),
                                   result.update->movedNodes.end());
        EXPECT_FALSE(listed.empty());
        EXPECT_TRUE(
            std::is_sorted(result.update->movedNodes.begin(), result.update->movedNodes.end()));
        for (std::size_t i = 0; i < base.positions.size(); ++i) {
          const bool differs = followed.positions[i] != base.positions[i];
          EXPECT_EQ(listed.contains(static_cast<int>(i)), differs);
          if (differs) {
            EXPECT_TRUE(influenced(c.solid, base.parameters[i], points)) << c.name << ' ' << i;
          } else {
            EXPECT_EQ(followed.parameters[i].u, base.parameters[i].u);
            EXPECT_EQ(followed.parameters[i].v, base.parameters[i].v);
          }
        }
      }
    }
  // Moves of up to 2 mm are small against edges of 4 mm; refined borders tolerate less.
  EXPECT_GT(updates, 3 * trials / 4) << trials;
}

TEST(Follow, WithoutBordersNodesAreEvaluatedAtTheirParameters) {
  Case c = cases()[0];
  c.regions.clear();
  const SurfaceMesh base = meshOf(c, c.solid);
  const Solid solid = moved(c.solid, {{30, {1.0, -0.5, 0.7}}});
  const FollowResult result = followSolid(base, c.solid, solid);
  ASSERT_TRUE(result.update) << result.remeshReason;
  const SurfaceEvaluator surface(solid);
  for (std::size_t i = 0; i < base.positions.size(); ++i) {
    const SurfaceParameter& at = base.parameters[i];
    EXPECT_LT((result.update->mesh.positions[i] - surface.position(at.patch, at.u, at.v)).norm(),
              1e-14 * 25.0);
  }
}

TEST(Follow, UndoingAMoveGivesTheSameBits) {
  for (const Case& c : cases()) {
    const SurfaceMesh base = meshOf(c, c.solid);
    EXPECT_TRUE(followSolid(base, c.solid, c.solid, c.regions).update->movedNodes.empty());
    const Solid there = moved(c.solid, {{5, {0.4, 0.3, 0.5}}, {20, {-0.4, 0.3, 0.5}}});
    ASSERT_TRUE(followSolid(base, c.solid, there, c.regions).update) << c.name;
    const Solid back = there.withControlPoints(c.solid.controlPoints());
    const FollowResult result = followSolid(base, c.solid, back, c.regions);
    ASSERT_TRUE(result.update);
    EXPECT_EQ(result.update->mesh.positions, base.positions);
  }
}

TEST(Follow, StepByStepNodesStayOnTheMovingBorder) {
  const Case c = cases()[0];
  Solid before = c.solid;
  SurfaceMesh current = meshOf(c, c.solid);
  const SurfaceMesh base = current;
  // The whole sphere grows, so every node of the border has to slide.
  for (int step = 1; step <= 5; ++step) {
    std::vector<Vector3d> points = c.solid.controlPoints();
    for (Vector3d& p : points) p *= 1.0 + 0.004 * step;
    const Solid solid = c.solid.withControlPoints(points);
    const FollowResult result = followSolid(current, before, solid, c.regions);
    ASSERT_TRUE(result.update) << result.remeshReason;
    EXPECT_EQ(result.update->movedNodes.size(), base.positions.size());
    current = result.update->mesh;
    before = solid;
    EXPECT_LT(largestBorderFault(current, base), 1e-9);
    EXPECT_LT(checks::distanceFromSurface(current, solid), 1e-12);
  }
}

std::string remeshReason(const Case& c, const Solid& solid) {
  return followSolid(meshOf(c, c.solid), c.solid, solid, c.regions).remeshReason;
}

TEST(Follow, ReportsWhyTheSolidNeedsANewMesh) {
  const std::vector<Case> all = cases();
  const Case& sphere = all[0];
  const auto has = [](const std::string& text, const char* part) {
    return testing::AssertionResult(text.find(part) != std::string::npos) << text;
  };
  EXPECT_TRUE(has(remeshReason(sphere, makeSphere(25.0, 9)), "patches"));
  // A distant point stretches its edges.
  int top = 0;
  for (std::size_t i = 0; i < sphere.solid.controlPoints().size(); ++i)
    if (sphere.solid.controlPoints()[i].z() > sphere.solid.controlPoints()[top].z())
      top = static_cast<int>(i);
  EXPECT_TRUE(has(remeshReason(sphere, moved(sphere.solid, {{top, {0, 0, 60}}})), "edge near"));
  // A bulge that passes through the plane of the support.
  EXPECT_FALSE(remeshReason(sphere, moved(sphere.solid, {{top, {0, 0, -100}}})).empty());

  std::vector<MeshRegion> other = sphere.regions;
  other[0].where = Region::below({0, 0, 1}, -11.0);
  EXPECT_TRUE(
      has(followSolid(meshOf(sphere, sphere.solid), sphere.solid, sphere.solid, other).remeshReason,
          "the supports, the loads"));
  // The top of the box is pressed onto the border of the half space.
  const Case& box = all[2];
  std::vector<Vector3d> points = box.solid.controlPoints();
  for (Vector3d& p : points) p.z() *= 0.3;
  EXPECT_FALSE(remeshReason(box, box.solid.withControlPoints(points)).empty());
}

TEST(Follow, ASurfaceThatReachesAHalfSpaceElsewhereNeedsANewMesh) {
  // Only the bottom of the box is below z = 1; then the middle of the top is pulled down to it. The
  // triangles stay well shaped because the whole top moves.
  Case c{"box", makeBox({40, 30, 20}), 5.0, {{"load", Region::below({0, 0, -1}, -19.0), true}}};
  std::vector<Vector3d> points = c.solid.controlPoints();
  for (Vector3d& p : points)
    if (p.z() < 1e-9 && std::abs(p.x()) < 15.0 && std::abs(p.y()) < 12.0) p.z() += 1.0;
  const Solid dented = c.solid.withControlPoints(points);
  EXPECT_TRUE(followSolid(meshOf(c, c.solid), c.solid, dented, c.regions).update);
  // The rim of the dent in the bottom reaches the border of the support at z = 0.4.
  c.regions = {{"base", Region::below({0, 0, 1}, 0.4), true}};
  EXPECT_NE(remeshReason(c, dented).find("crossed the border"), std::string::npos)
      << remeshReason(c, dented);
}

TEST(Follow, MeshBodiesAndOtherMeshesAreCallersBugs) {
  const Case c = cases()[0];
  SurfaceMesh base = meshOf(c, c.solid);
  SurfaceMesh fewer = base;
  fewer.positions.pop_back();
  EXPECT_THROW(differingNodes(base, fewer), std::invalid_argument);
  base.parameters.clear();
  EXPECT_THROW(followSolid(base, c.solid, c.solid, c.regions), std::invalid_argument);
}

}  // namespace
}  // namespace palpa::modeling
