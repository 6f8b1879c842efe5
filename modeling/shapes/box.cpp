#include "modeling/shapes/cube_face.h"
#include "modeling/shapes/describe_shape.h"

namespace palpa::modeling {

using Eigen::Vector3d;

ExactShape describe(const BoxShape& box, const NetSize& net) {
  const Vector3d size = box.size;
  ExactShape shape;
  shape.smallestLength = checkLengths(
      "box",
      {{"the size in x", size.x()}, {"the size in y", size.y()}, {"the size in z", size.z()}});
  const SplineBasis basis = uniformBasis(net.degree, net.countOr(net.degree + 1));
  for (const CubeFace& face : cubeFaces()) {
    const auto surface = [size, face](double s, double t) {
      const Vector3d unit = face.normal + (2.0 * s - 1.0) * face.u + (2.0 * t - 1.0) * face.v;
      return Vector3d(0.5 * size.x() * unit.x(), 0.5 * size.y() * unit.y(),
                      0.5 * size.z() * (unit.z() + 1.0));
    };
    shape.patches.push_back({face.name, {basis, basis}, surface, {}});
  }
  return shape;
}

}  // namespace palpa::modeling
