#include "bem/model/boundary_mesh.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "app/verification/exact/simple_meshes.h"
#include "bem/base/error.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

BoundaryMesh box() {
  return verification::boxMesh({0, 0, 0}, {4, 3, 2}, 4, 3, 2);
}

/// Message of the error, which must have the kind kBadMesh; empty if there was none.
std::string refusal(const BoundaryMesh& mesh) {
  try {
    mesh.validate();
  } catch (const SolverError& error) {
    EXPECT_EQ(error.kind(), SolverError::Kind::kBadMesh);
    return error.what();
  }
  return "";
}

void expectInMessage(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << "message: " << message;
}

TEST(BoundaryMesh, MeasuresOfABox) {
  const BoundaryMesh mesh = box();
  EXPECT_NEAR(mesh.volume(), 24, 1e-12);
  EXPECT_NEAR(mesh.surfaceArea(), 52, 1e-12);
  EXPECT_NEAR(mesh.boundingSize(), std::sqrt(29.0), 1e-12);
  EXPECT_GT(mesh.meanEdgeLength(), 1.0);
  EXPECT_LT(mesh.meanEdgeLength(), std::sqrt(2.0));
}

TEST(BoundaryMesh, MeasuresConvergeToTheTrueBodies) {
  constexpr double kPi = std::numbers::pi;
  // Chords of at least 24 segments per turn: 1 - cos(pi/24) = 0.9 %, twice.
  EXPECT_NEAR(verification::sphereMesh(10, 8).volume(), 4 / 3.0 * kPi * 1e3, 0.02 * 4189);
  EXPECT_NEAR(verification::hollowSphereMesh(5, 10, 6, 8).volume(), 4 / 3.0 * kPi * 875,
              0.02 * 3665);
  EXPECT_NEAR(verification::cylinderMesh(10, 20, 32, 8).volume(), 2e3 * kPi, 0.02 * 6283);
  EXPECT_NEAR(verification::hollowCylinderMesh(5, 10, 20, 32, 8).volume(), 1.5e3 * kPi,
              0.02 * 4712);
  EXPECT_NEAR(verification::torusMesh(30, 10, 48, 24).volume(), 6e3 * kPi * kPi, 0.02 * 59218);
}

TEST(BoundaryMesh, AcceptsEveryTestBody) {
  EXPECT_EQ(refusal(box()), "");
  EXPECT_EQ(refusal(verification::sphereMesh(10, 4)), "");
  EXPECT_EQ(refusal(verification::hollowSphereMesh(5, 10, 3, 4)), "");
  EXPECT_EQ(refusal(verification::cylinderMesh(5, 10, 16, 6)), "");
  EXPECT_EQ(refusal(verification::hollowCylinderMesh(5, 10, 20, 16, 6)), "");
  EXPECT_EQ(refusal(verification::torusMesh(10, 3, 16, 8)), "");
}

TEST(BoundaryMesh, RefusesAnEmptyMesh) {
  expectInMessage(refusal(BoundaryMesh{}), "no triangles");
}

TEST(BoundaryMesh, RefusesAnOpenSurface) {
  BoundaryMesh mesh = box();
  mesh.triangles.pop_back();
  mesh.smoothingGroups.pop_back();
  mesh.tags.pop_back();
  expectInMessage(refusal(mesh), "open");
}

TEST(BoundaryMesh, RefusesAFlippedTriangle) {
  BoundaryMesh mesh = box();
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  expectInMessage(refusal(mesh), "not a manifold at the edge from node");
}

TEST(BoundaryMesh, RefusesATriangleUsedTwice) {
  BoundaryMesh mesh = box();
  mesh.triangles.push_back(mesh.triangles[0]);
  mesh.smoothingGroups.push_back(0);
  mesh.tags.push_back(0);
  expectInMessage(refusal(mesh), "not a manifold");
}

TEST(BoundaryMesh, RefusesCoordinatesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    BoundaryMesh mesh = box();
    mesh.nodes[7][1] = bad;
    expectInMessage(refusal(mesh), "node 7 has a coordinate that is not finite");
  }
}

TEST(BoundaryMesh, RefusesAnInvertedSurface) {
  BoundaryMesh mesh = box();
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  expectInMessage(refusal(mesh), "inside out");
}

TEST(BoundaryMesh, RefusesATriangleWithoutArea) {
  BoundaryMesh mesh = box();
  const auto [a, b, c] = mesh.triangles[3];
  mesh.nodes[c] = (mesh.nodes[a] + mesh.nodes[b]) / 2;
  expectInMessage(refusal(mesh), "has no area");
  mesh = box();
  mesh.triangles[3][2] = mesh.triangles[3][0];
  expectInMessage(refusal(mesh), "triangle 3 has no area");
}

TEST(BoundaryMesh, RefusesAnIndexOutOfRange) {
  for (const int bad : {-1, 1000}) {
    BoundaryMesh mesh = box();
    mesh.triangles[2][1] = bad;
    const std::string message = refusal(mesh);
    expectInMessage(message, "triangle 2 names node " + std::to_string(bad));
    expectInMessage(message, "there are " + std::to_string(mesh.nodeCount()));
  }
}

TEST(BoundaryMesh, RefusesListsOfDifferentLength) {
  BoundaryMesh mesh = box();
  mesh.tags.pop_back();
  expectInMessage(refusal(mesh), "one entry per triangle");
  mesh = box();
  mesh.smoothingGroups.push_back(0);
  expectInMessage(refusal(mesh), "one entry per triangle");
}

TEST(TractionSlots, ThreeAtACornerTwoAtAnEdgeOneOnAFace) {
  const BoundaryMesh mesh = box();
  const TractionSlots slots(mesh);
  std::map<int, int> nodesWith;
  for (int k = 0; k < mesh.nodeCount(); ++k) {
    const Vector3d& x = mesh.nodes[k];
    const int faces =
        (x[0] == 0 || x[0] == 4) + (x[1] == 0 || x[1] == 3) + (x[2] == 0 || x[2] == 2);
    EXPECT_EQ(slots.firstOfNode[k + 1] - slots.firstOfNode[k], faces);
    ++nodesWith[faces];
  }
  EXPECT_EQ(nodesWith[3], 8);
  EXPECT_EQ(nodesWith[2], 4 * (3 + 2 + 1));
  EXPECT_EQ(slots.count(), slots.firstOfNode.back());
}

TEST(TractionSlots, BelongToTheirNodeAndFace) {
  const BoundaryMesh mesh = box();
  const TractionSlots slots(mesh);
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const auto& slot = slots.slots[slots.ofCorner[t][corner]];
      EXPECT_EQ(slot.node, mesh.triangles[t][corner]);
      EXPECT_EQ(slot.tag, mesh.tags[t]);
      EXPECT_EQ(slot.smoothingGroup, mesh.smoothingGroups[t]);
      // Normals are not averaged across a sharp edge.
      EXPECT_LE((slot.normal - mesh.normal(t)).norm(), 1e-14);
    }
}

TEST(TractionSlots, SplitAtTheBorderOfASupportOnASmoothFace) {
  BoundaryMesh mesh = verification::sphereMesh(10, 6);
  for (int t = 0; t < mesh.triangleCount(); ++t)
    mesh.tags[t] = mesh.point(t, Vector3d::Constant(1 / 3.0))[2] < -6 ? 1 : 0;
  const TractionSlots slots(mesh);
  for (int k = 0; k < mesh.nodeCount(); ++k) {
    std::set<int> tags;
    for (int t = 0; t < mesh.triangleCount(); ++t)
      for (const int node : mesh.triangles[t])
        if (node == k) tags.insert(mesh.tags[t]);
    EXPECT_EQ(slots.firstOfNode[k + 1] - slots.firstOfNode[k], static_cast<int>(tags.size()));
  }
  EXPECT_GT(slots.count(), mesh.nodeCount());
}

TEST(TractionSlots, MeanNormalOfASphereIsRadial) {
  const BoundaryMesh mesh = verification::sphereMesh(10, 8);
  // One cell spans 11 degrees; the remaining error is its skew, a quarter of 11 degrees squared, in
  // radians.
  for (const auto& slot : TractionSlots(mesh).slots)
    EXPECT_LE((slot.normal - mesh.nodes[slot.node].normalized()).norm(), 0.01);
}

}  // namespace
}  // namespace palpa::bem
