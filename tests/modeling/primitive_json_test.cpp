#include <gtest/gtest.h>

#include "modeling/project/json_values.h"

namespace palpa::modeling {
namespace {

ProfileCurve segment() {
  return {1, {0, 0, 0.1, 1, 1}, {{0, 0}, {1.0 / 3.0, 2}, {4, 0}}};
}

std::vector<Primitive> examples() {
  return {{BoxShape{{1, 2, 0.1}}, 1, 2},
          {SphereShape{25.0}, 3, 7},
          {EllipsoidShape{{3, 2, 1e-3}}, 2, 0},
          {CylinderShape{15.0, 40.0}, 3, 0},
          {ConeShape{20.0, 0.0, 30.0}, 5, 64},
          {CapsuleShape{10.0, 1.0 / 3.0}, 3, 0},
          {TorusShape{25.0, 8.0}, 3, 9},
          {RevolveShape{segment()}, 3, 0},
          {ExtrudeShape{segment(), 20.0}, 3, 0},
          {LoftShape{{{-1.0, segment()}, {2.5, segment()}}}, 4, 0}};
}

TEST(PrimitiveJson, EveryKindIsReadAsWritten) {
  for (const Primitive& primitive : examples()) {
    const std::string text = jsonText(jsonOf(primitive));
    const Primitive again = primitiveFrom(nlohmann::json::parse(text));
    EXPECT_EQ(again.shape.index(), primitive.shape.index()) << text;
    EXPECT_EQ(again.degree, primitive.degree) << text;
    EXPECT_EQ(again.controlPoints, primitive.controlPoints) << text;
    EXPECT_EQ(jsonText(jsonOf(again)), text);
  }
}

TEST(PrimitiveJson, HasTheKeysOfTheSchema) {
  EXPECT_EQ(jsonText(jsonOf(Primitive{SphereShape{25.0}, 3, 7})),
            R"({"kind": "sphere", "radius_mm": 25, "degree": 3, "control_points": 7})");
  EXPECT_EQ(
      jsonText(jsonOf(Primitive{ExtrudeShape{segment(), 20.0}, 2, 0})),
      R"({"kind": "extrude", "profile": {"degree": 1, "knots": [0, 0, 0.1, 1, 1], "points_mm": )"
      R"([[0, 0], [0.3333333333333333, 2], [4, 0]]}, "height_mm": 20, "degree": 2})");
}

TEST(PrimitiveJson, OnlyTheLengthsAreRequired) {
  const Primitive cone = primitiveFrom(nlohmann::json::parse(
      R"({"kind": "cone", "bottom_radius_mm": 3, "top_radius_mm": 2, "height_mm": 1})"));
  EXPECT_EQ(std::get<ConeShape>(cone.shape).bottomRadius, 3.0);
  EXPECT_EQ(std::get<ConeShape>(cone.shape).topRadius, 2.0);
  EXPECT_EQ(std::get<ConeShape>(cone.shape).height, 1.0);
  EXPECT_EQ(cone.degree, 3);
  EXPECT_EQ(cone.controlPoints, 0);
}

}  // namespace
}  // namespace palpa::modeling
