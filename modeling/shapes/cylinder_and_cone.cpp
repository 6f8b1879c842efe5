#include <cmath>
#include <numbers>

#include "modeling/shapes/describe_shape.h"
#include "modeling/shapes/round_patches.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Cone with four patches from the apex to the rim and four patches over the bottom.
ExactShape coneWithApex(const ConeShape& cone, const NetSize& net) {
  ExactShape shape;
  shape.smallestLength =
      checkLengths("cone", {{"the bottom radius", cone.bottomRadius}, {"the height", cone.height}});
  const RoundNet round{true, net.fromApex()};
  addDisc(shape, "side", round, true, false, [cone](const Vector3d& flat) {
    const Vector3d unit = std::numbers::sqrt2 * flat;
    return Vector3d(cone.bottomRadius * unit +
                    cone.height * (1.0 - unit.norm()) * Vector3d::UnitZ());
  });
  addFlatDisc(shape, "bottom", round, false, false, {cone.bottomRadius, 0.0});
  return shape;
}

}  // namespace

ExactShape describe(const CylinderShape& cylinder, const NetSize& net) {
  const auto [radius, height] = cylinder;
  ExactShape shape;
  shape.smallestLength = checkLengths("cylinder", {{"the radius", radius}, {"the height", height}});
  const RoundNet round{false, uniformBasis(net.degree, net.aroundQuarter())};
  const auto side = [cylinder](const Vector3d& radial, double t) {
    return Vector3d(cylinder.radius * radial + t * cylinder.height * Vector3d::UnitZ());
  };
  addBand(shape, "side", round, uniformBasis(net.degree, net.alongLine()), side, false, false);
  addFlatDisc(shape, "bottom", round, false, false, {radius, 0.0});
  addFlatDisc(shape, "top", round, true, false, {radius, height});
  return shape;
}

ExactShape describe(const ConeShape& cone, const NetSize& net) {
  if (cone.topRadius == 0.0) return coneWithApex(cone, net);
  ExactShape shape;
  shape.smallestLength = checkLengths("cone", {{"the bottom radius", cone.bottomRadius},
                                               {"the top radius", cone.topRadius},
                                               {"the height", cone.height}});
  const RoundNet round{false, uniformBasis(net.degree, net.aroundQuarter())};
  const auto side = [cone](const Vector3d& radial, double t) {
    const double radius = cone.bottomRadius + t * (cone.topRadius - cone.bottomRadius);
    return Vector3d(radius * radial + t * cone.height * Vector3d::UnitZ());
  };
  addBand(shape, "side", round, uniformBasis(net.degree, net.alongLine()), side, false, false);
  addFlatDisc(shape, "bottom", round, false, false, {cone.bottomRadius, 0.0});
  addFlatDisc(shape, "top", round, true, false, {cone.topRadius, cone.height});
  return shape;
}

}  // namespace palpa::modeling
