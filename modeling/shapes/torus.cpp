#include <cmath>
#include <numbers>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/shapes/cube_face.h"
#include "modeling/shapes/describe_shape.h"
#include "modeling/shapes/round_patches.h"

namespace palpa::modeling {

using Eigen::Vector3d;

ExactShape describe(const TorusShape& torus, const NetSize& net) {
  const auto [major, minor] = torus;
  ExactShape shape;
  shape.smallestLength =
      checkLengths("torus", {{"the major radius", major}, {"the minor radius", minor}});
  if (!(minor <= major - kMinLength))
    throw ModelingError("torus: the minor radius is " + numberText(minor) +
                        " mm; it must be smaller than the major radius, " + numberText(major) +
                        " mm, by at least " + numberText(kMinLength) + " mm, or the hole closes");
  const SplineBasis basis = uniformBasis(net.degree, net.aroundQuarter());
  constexpr std::array<const char*, 4> kNames{"outer", "top", "inner", "bottom"};
  for (int quarter = 0; quarter < 4; ++quarter) {
    const auto point = [torus, quarter](const Vector3d& radial, double t) {
      const double angle = quarter * (std::numbers::pi / 2) + quarterAngle(t);
      return Vector3d((torus.majorRadius + torus.minorRadius * std::cos(angle)) * radial +
                      torus.minorRadius * std::sin(angle) * Vector3d::UnitZ());
    };
    addBand(shape, kNames[quarter], {false, basis}, basis, point, true, true);
  }
  return shape;
}

}  // namespace palpa::modeling
