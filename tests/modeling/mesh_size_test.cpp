// Node distribution of the mesher: factors of patches, curved edges, narrow patches.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh_checks.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/mesh_counts.h"
#include "modeling/shapes/primitive.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

MeshSettings edgeLength(double h) {
  MeshSettings settings;
  settings.edgeLength = h;
  return settings;
}

double meanArea(const SurfaceMesh& mesh, int patch) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.patchOfTriangle[t] != patch) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    sum +=
        0.5 *
        (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]).norm();
    ++count;
  }
  return sum / count;
}

TEST(PatchFactors, RefineAPatchAndMatchTheOthers) {
  const Solid box = makeBox({40, 30, 20});
  MeshSettings settings = edgeLength(5.0);
  const SurfaceMesh plain = mesh(box, settings);
  settings.patchFactors = {{"top", 0.5}};
  const SurfaceMesh finer = mesh(box, settings);
  EXPECT_EQ(checks::manifoldFault(finer), "");
  const int top = *box.findPatch("top");
  EXPECT_NEAR(meanArea(finer, top) / meanArea(plain, top), 0.25, 1e-9);
  // 16 × 12 cells on top (and, opposite, on the bottom), 4 along z.
  EXPECT_EQ(finer.positions.size(), 2U * 17 * 13 + 3U * 2 * (16 + 12));
  EXPECT_EQ(estimateNodeCount(box, settings), static_cast<double>(finer.positions.size()));
  settings.patchFactors = {{"top", 1.0}, {"bottom", 1.0}};
  EXPECT_EQ(mesh(box, settings).positions, plain.positions);
}

TEST(PatchFactors, AreChecked) {
  const Solid box = makeBox({40, 30, 20});
  const auto message = [&](std::map<std::string, double> factors) -> std::string {
    MeshSettings settings = edgeLength(5.0);
    settings.patchFactors = std::move(factors);
    try {
      mesh(box, settings);
    } catch (const ModelingError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({{"lid", 0.5}}).find("no patch \"lid\"; the patches are \"side_xmin\""),
            std::string::npos)
      << message({{"lid", 0.5}});
  for (double factor : {0.0, -1.0, 0.01, 100.0, std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()})
    EXPECT_EQ(message({{"top", factor}}).find("mesh.patch_factors.top: "), 0U) << factor;
}

TEST(Bends, AQuarterOfACircleIsCutIntoThreePieces) {
  const Solid cylinder = makeCylinder(20.0, 60.0);
  const SurfaceEvaluator surface(cylinder);
  const MeshSettings settings = edgeLength(100.0);
  const Counts counts = subdivisionCounts(cylinder, surface, patchEdgeLengths(cylinder, settings));
  for (const char* cap : {"bottom", "top"})
    for (double count : counts[*cylinder.findPatch(cap)]) EXPECT_EQ(count, 3.0);
}

TEST(Bends, PiecesOfAnEdgeAreShortWhereItBends) {
  // The sphere stretched along x: a flat middle and strongly curved ends.
  const Solid sphere = makeSphere(10.0);
  std::vector<Vector3d> points = sphere.controlPoints();
  for (Vector3d& p : points) p.x() *= 6.0;
  const Solid cigar = sphere.withControlPoints(points);
  const SurfaceEvaluator surface(cigar);
  const int patch = *cigar.findPatch("side_xmax");
  const auto [low, high] = surface.range(patch, 0);
  const IsoCurve curve(surface, patch, 0, 0.5 * (low + high));
  const double h = 40.0;
  EXPECT_GT(curve.pieces(h), 2.0 * curve.length() / h);
  const std::vector<double> cuts = curve.cut(static_cast<int>(std::ceil(curve.pieces(h))), h);
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    // By definition no piece turns by more than 30 degrees or is longer than h.
    const auto at = [&](double t) {
      return surface.evaluate(patch, low + t * (high - low), 0.5 * (low + high));
    };
    const SurfacePoint a = at(cuts[i - 1]);
    const SurfacePoint b = at(cuts[i]);
    EXPECT_GT(a.du.normalized().dot(b.du.normalized()), std::cos(1.05 * kPieceAngle));
    EXPECT_LT((b.position - a.position).norm(), h);
  }
  // Fine pieces turn by little, so they have equal length.
  EXPECT_NEAR(curve.pieces(0.05), curve.length() / 0.05, 1e-9);
}

TEST(NarrowPatches, HaveTrianglesOfBoundedAspect) {
  struct Case {
    Solid solid;
    double h;
  };
  for (const Case& c : {Case{makeBox({40, 40, 0.5}), 5.0}, Case{makeBox({40, 40, 0.5}), 2.0},
                        Case{makeCylinder(20.0, 0.5), 5.0}, Case{makeBox({40, 0.3, 20}), 5.0},
                        Case{makeCylinder(0.5, 40.0), 5.0}}) {
    const SurfaceMesh result = mesh(c.solid, edgeLength(c.h));
    EXPECT_EQ(checks::manifoldFault(result), "");
    const MeshQuality quality = measureQuality(result);
    EXPECT_LT(quality.largestAspect, 5.6) << c.h;
    EXPECT_GT(quality.smallestAngle, 15.0) << c.h;
    const double estimate = estimateNodeCount(c.solid, edgeLength(c.h));
    EXPECT_LT(std::abs(std::log(estimate / static_cast<double>(result.positions.size()))),
              std::log(5.0));
  }
}

// The cells of a thin ring are bent in both directions, and their diagonals shorter than their
// outer sides: 12 times as many nodes were made from long edges as from short ones.
TEST(NarrowPatches, OfThinRingsStayCoarse) {
  for (const double radius : {2.0, 5.0}) {
    const Solid ring = makePrimitive({TorusShape{24, radius}});
    for (const double h : {8.0, 12.9, 20.0, 40.0}) {
      const SurfaceMesh result = mesh(ring, edgeLength(h));
      EXPECT_EQ(checks::manifoldFault(result), "Euler characteristic 0");
      EXPECT_LT(result.positions.size(), 300U) << radius << " " << h;
      EXPECT_GT(measureQuality(result).smallestAngle, 18.0) << radius << " " << h;
    }
  }
}

}  // namespace
}  // namespace palpa::modeling
