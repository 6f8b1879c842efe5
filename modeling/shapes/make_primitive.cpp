#include "modeling/shapes/make_primitive.h"

#include <array>

#include "modeling/shapes/describe_shape.h"

namespace palpa::modeling {
namespace {

ExactShape describePrimitive(const Primitive& primitive) {
  const NetSize net = checkNetSize(shapeName(primitive), primitive);
  return std::visit([&](const auto& shape) { return describe(shape, net); }, primitive.shape);
}

}  // namespace

std::string shapeName(const Primitive& primitive) {
  constexpr std::array<const char*, 10> kNames{"box",     "sphere",  "ellipsoid", "cylinder",
                                               "cone",    "capsule", "torus",     "revolve",
                                               "extrude", "loft"};
  static_assert(std::variant_size_v<decltype(Primitive::shape)> == kNames.size());
  return kNames[primitive.shape.index()];
}

Solid makePrimitive(const Primitive& primitive) {
  return toSolid(describePrimitive(primitive));
}

MadeSolid makeMeasuredPrimitive(const Primitive& primitive) {
  const ExactShape shape = describePrimitive(primitive);
  MadeSolid made;
  made.solid = toSolid(shape);
  made.deviation = largestDeviation(shape, made.solid);
  return made;
}

}  // namespace palpa::modeling
