// The support that is proposed for a body without one.
#include "modeling/project/proposed_support.h"

#include <gtest/gtest.h>

#include "modeling/shapes/primitives.h"
#include "tests/modeling/test_bodies.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Names = std::vector<std::string>;

/// The solid, turned over about the x axis.
Solid turned(const Solid& solid) {
  std::vector<Vector3d> points;
  for (const Vector3d& p : solid.controlPoints()) points.push_back({p.x(), -p.y(), -p.z()});
  return solid.withControlPoints(points);
}

TEST(ProposedSupport, HoldsTheLargestFlatFaceAndOfTwoTheLowerOne) {
  const Body box = makeBox({40, 30, 10});
  const ProposedSupport base = proposeSupport(box);
  EXPECT_EQ(base.flatFace, Names{"bottom"});
  EXPECT_EQ(base.support.name, "base");
  EXPECT_EQ(base.support.kind, Support::Kind::kFixed);
  EXPECT_EQ(base.support.where, Region::ofPatches({"bottom"}));
  EXPECT_EQ(base.description(), "the largest flat face, \"bottom\"");
  EXPECT_EQ(proposeSupport(turned(makeBox({40, 30, 10}))).flatFace, Names{"top"});
  // The largest faces of an upright plate are its sides, wherever they look.
  EXPECT_EQ(proposeSupport(makeBox({5, 30, 40})).flatFace.size(), 1u);
  EXPECT_NE(proposeSupport(makeBox({5, 30, 40})).flatFace, Names{"bottom"});
}

TEST(ProposedSupport, HoldsTheCapOfACylinderButNotItsSide) {
  // The side is larger than the caps, but curved.
  EXPECT_EQ(proposeSupport(makeCylinder(10, 30)).flatFace, Names{"bottom"});
  const MeshBody tube = test::boredCylinder(20, 8, 25, 32);
  const ProposedSupport base = proposeSupport(tube);
  ASSERT_EQ(base.flatFace.size(), 0u) << "one face for all triangles is not flat";
  EXPECT_EQ(proposeSupport(test::bodyOf(makeCylinder(10, 30), 3)).flatFace, Names{"bottom"});
}

TEST(ProposedSupport, HoldsTheLowestTenthOfABodyWithoutFlatFaces) {
  for (const Body& body :
       {Body(makeSphere(25)), Body(test::torus(25, 8, 40, 16)), Body(test::icosphere(25, 3))}) {
    const ProposedSupport base = proposeSupport(body);
    EXPECT_TRUE(base.flatFace.empty());
    EXPECT_EQ(base.description(), "the lowest tenth");
    const auto& half = std::get<HalfSpace>(base.support.where.parts.front());
    const auto [low, high] = boundingBox(body);
    EXPECT_NEAR(half.below, low.z() + 0.1 * (high.z() - low.z()), 1e-9);
  }
}

TEST(ProposedSupport, UnitesAdjacentFacesInOnePlane) {
  // A box whose triangles are twelve faces.
  const MeshBody box = test::plainBox({40, 30, 10});
  Names names;
  std::vector<int> faces;
  for (int t = 0; t < 12; ++t) {
    names.push_back("f" + std::to_string(t));
    faces.push_back(t);
  }
  const MeshBody split({box.positions(), box.triangles(), faces, names});
  const ProposedSupport base = proposeSupport(split);
  ASSERT_EQ(base.flatFace.size(), 2u);
  for (const std::string& name : base.flatFace)
    for (const int corner : split.triangles()[*split.findFace(name)])
      EXPECT_EQ(split.positions()[corner].z(), 0.0);
}

}  // namespace
}  // namespace palpa::modeling
