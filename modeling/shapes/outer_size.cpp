#include "modeling/shapes/outer_size.h"

#include <algorithm>
#include <cmath>

#include "modeling/shapes/describe_shape.h"
#include "modeling/shapes/profile_sketch.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::array<Vector2d, 2> boxOf(const ProfileCurve& curve) {
  return ProfileSketch(curve).box();
}

void stretch(ProfileCurve& curve, int axis, double factor) {
  for (Vector2d& point : curve.points) point[axis] *= factor;
}

Vector3d sizeOf(const BoxShape& box) {
  return box.size;
}

Vector3d sizeOf(const SphereShape& sphere) {
  return Vector3d::Constant(2.0 * sphere.radius);
}

Vector3d sizeOf(const EllipsoidShape& ellipsoid) {
  return 2.0 * ellipsoid.radii;
}

Vector3d sizeOf(const CylinderShape& cylinder) {
  return {2.0 * cylinder.radius, 2.0 * cylinder.radius, cylinder.height};
}

Vector3d sizeOf(const ConeShape& cone) {
  const double width = 2.0 * std::max(cone.bottomRadius, cone.topRadius);
  return {width, width, cone.height};
}

Vector3d sizeOf(const CapsuleShape& capsule) {
  const double width = 2.0 * capsule.radius;
  return {width, width, capsule.length + width};
}

Vector3d sizeOf(const TorusShape& torus) {
  const double width = 2.0 * (torus.majorRadius + torus.minorRadius);
  return {width, width, 2.0 * torus.minorRadius};
}

Vector3d sizeOf(const RevolveShape& revolve) {
  const auto [low, high] = boxOf(revolve.profile);
  return {2.0 * high.x(), 2.0 * high.x(), high.y() - low.y()};
}

Vector3d sizeOf(const ExtrudeShape& extrude) {
  const auto [low, high] = boxOf(extrude.profile);
  return {high.x() - low.x(), high.y() - low.y(), extrude.height};
}

Vector3d sizeOf(const LoftShape& loft) {
  constexpr int kSamples = 32;  // per patch and direction
  auto [low, high] = boxOf(loft.sections.at(0).profile);
  const auto add = [&, &low = low, &high = high](const Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  };
  for (const LoftShape::Section& section : loft.sections)
    for (const Vector2d& corner : boxOf(section.profile)) add(corner);
  // Between the sections the surface may be wider than they are.
  const ExactShape shape = describe(loft, NetSize{});
  for (const ExactPatch& patch : shape.patches)
    for (int i = 0; i <= kSamples; ++i)
      for (int j = 0; j <= kSamples; ++j)
        add(patch.surface(static_cast<double>(i) / kSamples, static_cast<double>(j) / kSamples)
                .head<2>());
  return {high.x() - low.x(), high.y() - low.y(), loft.sections.back().z - loft.sections.front().z};
}

// The shapes below are changed in place; false if there is no such shape. `factor` is the new size
// divided by the old one.

bool setSize(BoxShape& box, int axis, double size, double /*factor*/) {
  box.size[axis] = size;
  return true;
}

bool setSize(SphereShape& sphere, int /*axis*/, double size, double /*factor*/) {
  sphere.radius = 0.5 * size;
  return true;
}

bool setSize(EllipsoidShape& ellipsoid, int axis, double size, double /*factor*/) {
  ellipsoid.radii[axis] = 0.5 * size;
  return true;
}

bool setSize(CylinderShape& cylinder, int axis, double size, double /*factor*/) {
  (axis == 2 ? cylinder.height : cylinder.radius) = axis == 2 ? size : 0.5 * size;
  return true;
}

bool setSize(ConeShape& cone, int axis, double size, double factor) {
  if (axis == 2) {
    cone.height = size;
  } else {
    cone.bottomRadius *= factor;
    cone.topRadius *= factor;
  }
  return true;
}

bool setSize(CapsuleShape& capsule, int axis, double size, double /*factor*/) {
  const double height = axis == 2 ? size : capsule.length + 2.0 * capsule.radius;
  if (axis != 2) capsule.radius = 0.5 * size;
  capsule.length = height - 2.0 * capsule.radius;
  return capsule.length > 0.0;
}

bool setSize(TorusShape& torus, int axis, double size, double /*factor*/) {
  const double width = axis == 2 ? 2.0 * (torus.majorRadius + torus.minorRadius) : size;
  if (axis == 2) torus.minorRadius = 0.5 * size;
  torus.majorRadius = 0.5 * width - torus.minorRadius;
  return torus.majorRadius > torus.minorRadius;
}

bool setSize(RevolveShape& revolve, int axis, double /*size*/, double factor) {
  stretch(revolve.profile, axis == 2 ? 1 : 0, factor);
  return true;
}

bool setSize(ExtrudeShape& extrude, int axis, double size, double factor) {
  if (axis == 2)
    extrude.height = size;
  else
    stretch(extrude.profile, axis, factor);
  return true;
}

bool setSize(LoftShape& loft, int axis, double /*size*/, double factor) {
  const double base = loft.sections.front().z;
  for (LoftShape::Section& section : loft.sections)
    if (axis == 2)
      section.z = base + factor * (section.z - base);
    else
      stretch(section.profile, axis, factor);
  return true;
}

}  // namespace

Vector3d outerSize(const Primitive& primitive) {
  return std::visit([](const auto& shape) { return sizeOf(shape); }, primitive.shape);
}

std::optional<Primitive> withOuterSize(const Primitive& primitive, int axis, double size) {
  const double before = outerSize(primitive)[axis];
  if (!(size > 0.0) || !std::isfinite(size) || !(before > 0.0)) return std::nullopt;
  Primitive result = primitive;
  const bool exists = std::visit(
      [&](auto& shape) { return setSize(shape, axis, size, size / before); }, result.shape);
  return exists ? std::optional(result) : std::nullopt;
}

}  // namespace palpa::modeling
