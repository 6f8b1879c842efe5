#include "modeling/shapes/outer_size.h"

#include <gtest/gtest.h>

#include "modeling/shapes/make_primitive.h"
#include "modeling/solid/tessellation.h"
#include "shape_checks.h"

namespace palpa::modeling {
namespace {

std::vector<Primitive> everyShape() {
  const ProfileCurve vase =
      checks::cubic({{14, 0}, {24, 8}, {27, 22}, {16, 34}, {10, 44}, {13, 54}, {18, 60}});
  const LoftShape loft{{{5, checks::roundCurve(20, 8)},
                        {20, checks::roundCurve(12, 8)},
                        {30, checks::roundCurve(17, 8)}}};
  return {{BoxShape{}},
          {SphereShape{}},
          {EllipsoidShape{}},
          {CylinderShape{}},
          {ConeShape{}},
          {CapsuleShape{}},
          {TorusShape{}},
          {RevolveShape{vase}},
          {ExtrudeShape{checks::roundCurve(20, 8), 12}},
          {loft}};
}

/// Size of the box around the surface, from many points.
Eigen::Vector3d measured(const Primitive& primitive) {
  const Solid solid = makePrimitive(primitive);
  const Tessellation tessellation(solid);
  const auto positions = tessellation.evaluate(solid.controlPoints()).positions;
  Eigen::Vector3d low = positions.front(), high = low;
  for (const auto& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return high - low;
}

TEST(OuterSize, IsTheBoxAroundTheSolid) {
  for (const Primitive& primitive : everyShape()) {
    const Eigen::Vector3d size = outerSize(primitive), made = measured(primitive);
    EXPECT_LT((size - made).norm(), 0.01 * made.norm()) << shapeName(primitive);
  }
}

TEST(OuterSize, CanBeGiven) {
  for (const Primitive& primitive : everyShape())
    for (int axis = 0; axis < 3; ++axis) {
      const double wanted = 1.1 * outerSize(primitive)[axis];
      const auto changed = withOuterSize(primitive, axis, wanted);
      ASSERT_TRUE(changed) << shapeName(primitive) << axis;
      EXPECT_NEAR(outerSize(*changed)[axis], wanted, 1e-9 * wanted) << shapeName(primitive);
      EXPECT_NO_THROW(makePrimitive(*changed));
    }
}

TEST(OuterSize, SimpleShapesKeepTheirOtherSizes) {
  const auto cone = withOuterSize({ConeShape{20, 10, 30}}, 0, 80);
  EXPECT_EQ(std::get<ConeShape>(cone->shape), (ConeShape{40, 20, 30}));
  const auto capsule = withOuterSize({CapsuleShape{10, 30}}, 1, 30);
  EXPECT_EQ(std::get<CapsuleShape>(capsule->shape), (CapsuleShape{15, 20}));
  const auto torus = withOuterSize({TorusShape{25, 8}}, 2, 20);
  EXPECT_EQ(std::get<TorusShape>(torus->shape), (TorusShape{23, 10}));
  EXPECT_FALSE(withOuterSize({TorusShape{25, 8}}, 2, 40));
  EXPECT_FALSE(withOuterSize({CapsuleShape{10, 30}}, 2, 15));
  EXPECT_FALSE(withOuterSize({SphereShape{}}, 0, -1));
}

}  // namespace
}  // namespace palpa::modeling
