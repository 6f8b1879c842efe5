#include "modeling/mesh/display_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "mesh_checks.h"
#include "modeling/mesh/mesh.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

SurfaceMesh meshOf(const Solid& solid, double h) {
  MeshSettings settings;
  settings.edgeLength = h;
  const std::vector<MeshRegion> regions{{"base", Region::below({0.1, 0.2, 1}, 4.0), true}};
  return mesh(solid, settings, regions);
}

/// Display mesh with vertices of equal position merged, in the form of the mesh checks.
SurfaceMesh merged(const DisplayMesh& display) {
  SurfaceMesh result;
  std::map<std::tuple<double, double, double>, int> number;
  const auto add = [&](int vertex) {
    const Vector3d& x = display.positions[vertex];
    const auto [entry, isNew] =
        number.emplace(std::tuple(x.x(), x.y(), x.z()), static_cast<int>(result.positions.size()));
    if (isNew) result.positions.push_back(x);
    return entry->second;
  };
  for (const auto& [a, b, c] : display.triangles)
    result.triangles.push_back({add(a), add(b), add(c)});
  return result;
}

void expectSound(const DisplayMesh& display, const SurfaceMesh& boundary, const std::string& name) {
  SCOPED_TRACE(name);
  EXPECT_EQ(checks::manifoldFault(merged(display)), "");
  ASSERT_EQ(display.normals.size(), display.positions.size());
  ASSERT_EQ(display.links.size(), display.positions.size());
  ASSERT_EQ(display.boundaryTriangle.size(), display.triangles.size());
  EXPECT_TRUE(std::is_sorted(display.boundaryTriangle.begin(), display.boundaryTriangle.end()));
  double longest = 0.0;
  for (const auto& n : boundary.triangles)
    for (int k = 0; k < 3; ++k)
      longest =
          std::max(longest, (boundary.positions[n[k]] - boundary.positions[n[(k + 1) % 3]]).norm());
  for (std::size_t i = 0; i < display.positions.size(); ++i) {
    const DisplayMesh::Link& link = display.links[i];
    EXPECT_NEAR(link.weights.sum(), 1.0, 1e-14);
    EXPECT_GE(link.weights.minCoeff(), 0.0);
    EXPECT_NEAR(display.normals[i].norm(), 1.0, 1e-12);
    Vector3d flat = Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      flat += link.weights[k] * boundary.positions[boundary.triangles[link.triangle][k]];
    EXPECT_LT((flat - display.positions[i]).norm(), 0.2 * longest);
    if (link.weights.maxCoeff() == 1.0) {
      EXPECT_EQ(flat, display.positions[i]);
    }
  }
  std::set<int> cutTriangles;
  for (std::size_t t = 0; t < display.triangles.size(); ++t) {
    const int whole = display.boundaryTriangle[t];
    cutTriangles.insert(whole);
    EXPECT_EQ(display.patchOfTriangle[t], boundary.patchOfTriangle[whole]);
    const auto& [a, b, c] = display.triangles[t];
    const Vector3d normal = (display.positions[b] - display.positions[a])
                                .cross(display.positions[c] - display.positions[a]);
    // In the corners of round caps, where du and dv are parallel, pieces may have no area.
    const bool hasArea = normal.norm() > 0.01;
    for (int vertex : display.triangles[t]) {
      // Coarse flat pieces of a curved surface are inclined to its normals.
      EXPECT_TRUE(!hasArea || normal.dot(display.normals[vertex]) > 0.2 * normal.norm());
      EXPECT_EQ(boundary.smoothingGroupOfTriangle[display.links[vertex].triangle],
                boundary.smoothingGroupOfTriangle[whole]);
    }
  }
  EXPECT_EQ(cutTriangles.size(), boundary.triangles.size());
}

TEST(DisplayMesh, IsConformingOnTheSurfaceAndLinked) {
  for (const auto& [name, solid] :
       {std::pair("sphere", makeSphere(25.0)), std::pair("cylinder", makeCylinder(20.0, 60.0)),
        std::pair("box", makeBox({40, 30, 20}))})
    for (double h : {100.0, 12.0, 5.0}) {
      const SurfaceMesh boundary = meshOf(solid, h);
      for (int fixed : {0, 1, 2, 5, 8}) {
        DisplaySettings settings;
        if (fixed > 0) settings.leastPieces = settings.mostPieces = fixed;
        const DisplayMesh display = displayMesh(boundary, solid, settings);
        expectSound(display, boundary, name + std::string(" ") + std::to_string(fixed));
        if (fixed > 0) {
          EXPECT_EQ(display.triangles.size(), fixed * fixed * boundary.triangles.size());
          EXPECT_EQ(display.edgeLines.size(), fixed * boundary.triangles.size() * 3 / 2);
        }
      }
    }
}

TEST(DisplayMesh, VerticesAndNormalsLieOnTheSphere) {
  const Solid sphere = makeSphere(25.0);
  const DisplayMesh display = displayMesh(meshOf(sphere, 9.0), sphere);
  for (std::size_t i = 0; i < display.positions.size(); ++i) {
    EXPECT_NEAR(display.positions[i].norm(), 25.0, 2e-4 * 25.0);
    EXPECT_GT(display.normals[i].dot(display.positions[i].normalized()), 1.0 - 1e-4);
  }
  // Smooth everywhere: no vertex is duplicated.
  EXPECT_EQ(merged(display).positions.size(), display.positions.size());
}

TEST(DisplayMesh, SilhouettesImproveWithTheSquareOfThePieces) {
  const Solid cylinder = makeCylinder(20.0, 60.0);
  const SurfaceMesh boundary = meshOf(cylinder, 10.0);
  const double exact = std::numbers::pi * 24000.0;
  const auto error = [&](int pieces) {
    DisplaySettings settings;
    settings.leastPieces = settings.mostPieces = pieces;
    return 1.0 - checks::enclosedVolume(merged(displayMesh(boundary, cylinder, settings))) / exact;
  };
  EXPECT_NEAR(error(2) / error(1), 0.25, 0.05);
  EXPECT_NEAR(error(4) / error(1), 0.0625, 0.02);
}

TEST(DisplayMesh, NormalsSplitAtSharpEdges) {
  const Solid box = makeBox({40, 30, 20});
  const DisplayMesh display = displayMesh(meshOf(box, 10.0), box);
  int atCorner = 0;
  for (std::size_t i = 0; i < display.positions.size(); ++i) {
    EXPECT_NEAR(display.normals[i].cwiseAbs().maxCoeff(), 1.0, 1e-12);
    if ((display.positions[i] - Vector3d(20, 15, 20)).norm() < 1e-12) ++atCorner;
  }
  EXPECT_EQ(atCorner, 3);
}

TEST(DisplayMesh, PiecesFollowTheCurvature) {
  const auto piecesPerTriangle = [](const Solid& solid, double h) {
    const SurfaceMesh boundary = meshOf(solid, h);
    return static_cast<double>(displayMesh(boundary, solid).triangles.size()) /
           static_cast<double>(boundary.triangles.size());
  };
  EXPECT_EQ(piecesPerTriangle(makeBox({40, 30, 20}), 5.0), 4.0);
  EXPECT_GT(piecesPerTriangle(makeSphere(25.0), 12.0), 40.0);
  const double fine = piecesPerTriangle(makeSphere(25.0), 3.0);
  EXPECT_GE(fine, 4.0);
  EXPECT_LT(fine, 9.0);
  // The side of a cylinder is curved in one direction only, so it needs fewer pieces than a sphere
  // of equal radius.
  EXPECT_LT(piecesPerTriangle(makeCylinder(25.0, 60.0), 6.0),
            0.8 * piecesPerTriangle(makeSphere(25.0), 6.0));
}

TEST(DisplayMesh, MeshBodiesAreDividedFlat) {
  const SurfaceMesh box = meshOf(makeBox({40, 30, 20}), 10.0);
  MeshBody::Data data{
      box.positions, box.triangles, box.patchOfTriangle, {"a", "b", "c", "d", "e", "f"}};
  SurfaceMesh flat = box;
  flat.parameters.clear();
  const DisplayMesh display = displayMesh(flat, MeshBody(data));
  expectSound(display, flat, "mesh body");
  EXPECT_EQ(display.triangles.size(), 4 * box.triangles.size());
  EXPECT_NEAR(checks::enclosedVolume(merged(display)), 24000.0, 1e-8);
  for (const Vector3d& normal : display.normals)
    EXPECT_NEAR(normal.cwiseAbs().maxCoeff(), 1.0, 1e-12);
}

TEST(DisplayMesh, RefusesBadSettingsAndStops) {
  const Solid sphere = makeSphere(25.0);
  const SurfaceMesh boundary = meshOf(sphere, 9.0);
  for (const DisplaySettings& bad :
       {DisplaySettings{0, 8, 0.1}, DisplaySettings{3, 2, 0.1}, DisplaySettings{2, 9, 0.1},
        DisplaySettings{2, 8, 0.0}, DisplaySettings{2, 8, std::nan("")}})
    EXPECT_THROW(displayMesh(boundary, sphere, bad), std::invalid_argument);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(displayMesh(boundary, sphere, {}, {source.get_token(), {}}), Cancelled);
}

}  // namespace
}  // namespace palpa::modeling
