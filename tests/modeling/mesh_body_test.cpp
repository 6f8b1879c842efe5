#include "modeling/body/mesh_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "modeling/body/body.h"
#include "modeling/body/smooth_regions.h"
#include "modeling/error.h"
#include "test_bodies.h"

namespace palpa::modeling {
namespace {

MeshBody::Data boxData() {
  const MeshBody box = test::plainBox({1, 2, 3});
  return {box.positions(), box.triangles(), box.faceOfTriangle(), box.faceNames()};
}

void expectRefused(const MeshBody::Data& data, const std::string& part) {
  try {
    MeshBody{data};
    FAIL() << "was not refused: " << part;
  } catch (const ModelingError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(MeshBodyTest, KnowsItsVolumeAreaAndFaces) {
  const MeshBody box(boxData());
  EXPECT_NEAR(volume(box), 6.0, 1e-12);
  EXPECT_NEAR(area(box), 22.0, 1e-12);
  EXPECT_EQ(box.findFace("all"), 0);
  EXPECT_EQ(box.findFace("none"), std::nullopt);
  const auto corners = boundingBox(Body(box));
  EXPECT_EQ(corners[0], Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(corners[1], Eigen::Vector3d(1, 2, 3));
  const MeshBody hollow = test::hollowSphere(10, 5, 4);
  EXPECT_NEAR(volume(hollow), 4.0 / 3.0 * std::numbers::pi * 875.0, 20.0);
}

TEST(MeshBodyTest, EveryBrokenInvariantIsNamed) {
  MeshBody::Data data = boxData();
  data.positions[3].y() = std::nan("");
  expectRefused(data, "mesh_body.vertices_mm[3]");
  data = boxData();
  data.positions[3].y() = 1e8;
  expectRefused(data, "mesh_body.vertices_mm[3]");
  data = boxData();
  data.triangles[5][1] = 8;
  expectRefused(data, "mesh_body.triangles[5]: an index is out of range; there are 8");
  data.triangles[5][1] = -1;
  expectRefused(data, "mesh_body.triangles[5]");
  data.triangles[5][1] = data.triangles[5][0];
  expectRefused(data, "uses a vertex twice");
  data = boxData();
  data.triangles.clear();
  data.faceOfTriangle.clear();
  expectRefused(data, "mesh_body.triangles: is empty");
  data = boxData();
  data.faceNames = {""};
  expectRefused(data, "mesh_body.faces[0].name: is empty");
  data.faceNames = {"all", "all"};
  expectRefused(data, "mesh_body.faces[1].name: \"all\" is already");
  data.faceNames = {"all", "none"};
  expectRefused(data, "mesh_body.faces[1]: has no triangle");
  data = boxData();
  data.faceOfTriangle[2] = 1;
  expectRefused(data, "belongs to no face");
  data = boxData();
  data.faceOfTriangle.pop_back();
  expectRefused(data, "must cover every triangle");
  data = boxData();
  data.triangles.pop_back();
  data.faceOfTriangle.pop_back();
  expectRefused(data, "has one triangle only");
  data = boxData();
  std::swap(data.triangles[0][0], data.triangles[0][1]);
  expectRefused(data, "mesh_body: the edge between the vertices 0 and");
  data = boxData();
  data.positions.emplace_back(0, 0, 0);
  expectRefused(data, "mesh_body.vertices_mm[8]: belongs to no triangle");
  data = boxData();
  for (auto& t : data.triangles) std::swap(t[0], t[1]);
  expectRefused(data, "the enclosed volume is -6");
}

TEST(MeshBodyTest, SmoothRegionsEndAtSharpEdges) {
  const auto count = [](const MeshBody& body) {
    const auto regions = smoothRegions(body.positions(), body.triangles(), 0.0, 1000);
    return *std::max_element(regions.begin(), regions.end()) + 1;
  };
  EXPECT_EQ(count(test::plainBox({1, 2, 3})), 6);
  EXPECT_EQ(count(test::icosphere(10, 2)), 1);
  EXPECT_EQ(count(test::icosphere(10, 0)), 20);  // 42° between the faces of an icosahedron
  EXPECT_EQ(count(test::hollowSphere(10, 5, 2)), 2);
  EXPECT_EQ(count(test::boredCylinder(20, 5, 30, 32)), 4);
  EXPECT_EQ(count(test::withSlivers(test::plainBox({1, 2, 3}))), 6);
}

}  // namespace
}  // namespace palpa::modeling
