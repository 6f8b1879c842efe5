// Sphere, ellipsoid and capsule: a cube whose faces are mapped to the sphere by equal angles, so
// there is no pole.
#include <cmath>

#include "modeling/shapes/cube_face.h"
#include "modeling/shapes/describe_shape.h"
#include "modeling/shapes/round_patches.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr std::array<bool, 4> kAllSmooth{true, true, true, true};

/// Direction from the centre through the face; s and t from 0 to 1 are equal angles.
Vector3d direction(const CubeFace& face, double s, double t) {
  return (face.normal + std::tan(quarterAngle(s)) * face.u + std::tan(quarterAngle(t)) * face.v)
      .normalized();
}

/// Adds the half of the sphere above (sign 1) or below (sign -1) its equator, shifted by `offset`
/// along z: a face of the cube and the halves of the four sides next to it.
void addHalfSphere(ExactShape& shape, const CapsuleShape& capsule, const NetSize& net, int sign) {
  const SplineBasis around = uniformBasis(net.degree, net.aroundQuarter());
  const SplineBasis upwards = uniformBasis(net.degree, net.alongLine());
  const double radius = capsule.radius;
  const double offset = 0.5 * sign * capsule.length;
  for (const CubeFace& face : cubeFaces()) {
    if (face.isSide()) {
      const auto surface = [=](double s, double t) {
        const double height = sign > 0 ? 0.5 + 0.5 * t : 0.5 * t;
        return Vector3d(radius * direction(face, s, height) + offset * Vector3d::UnitZ());
      };
      const std::string name = sign > 0 ? "top" : "bottom";
      shape.patches.push_back(
          {name + std::string(face.name).substr(4), {around, upwards}, surface, kAllSmooth});
    } else if (face.normal.z() == sign) {
      const auto surface = [=](double s, double t) {
        return Vector3d(radius * direction(face, s, t) + offset * Vector3d::UnitZ());
      };
      shape.patches.push_back({face.name, {around, around}, surface, kAllSmooth});
    }
  }
}

}  // namespace

ExactShape describe(const SphereShape& sphere, const NetSize& net) {
  ExactShape shape;
  shape.smallestLength = checkLengths("sphere", {{"the radius", sphere.radius}});
  const SplineBasis basis = uniformBasis(net.degree, net.aroundQuarter());
  for (const CubeFace& face : cubeFaces()) {
    const auto surface = [radius = sphere.radius, face](double s, double t) {
      return Vector3d(radius * direction(face, s, t));
    };
    shape.patches.push_back({face.name, {basis, basis}, surface, kAllSmooth});
  }
  return shape;
}

ExactShape describe(const EllipsoidShape& ellipsoid, const NetSize& net) {
  const Vector3d radii = ellipsoid.radii;
  ExactShape shape;
  shape.smallestLength = checkLengths("ellipsoid", {{"the radius in x", radii.x()},
                                                    {"the radius in y", radii.y()},
                                                    {"the radius in z", radii.z()}});
  const SplineBasis basis = uniformBasis(net.degree, net.aroundQuarter());
  for (const CubeFace& face : cubeFaces()) {
    const auto surface = [radii, face](double s, double t) {
      return Vector3d(radii.cwiseProduct(direction(face, s, t)));
    };
    shape.patches.push_back({face.name, {basis, basis}, surface, kAllSmooth});
  }
  return shape;
}

ExactShape describe(const CapsuleShape& capsule, const NetSize& net) {
  ExactShape shape;
  shape.smallestLength =
      checkLengths("capsule", {{"the radius", capsule.radius}, {"the length", capsule.length}});
  const RoundNet round{false, uniformBasis(net.degree, net.aroundQuarter())};
  const auto side = [capsule](const Vector3d& radial, double t) {
    return Vector3d(capsule.radius * radial + (t - 0.5) * capsule.length * Vector3d::UnitZ());
  };
  addHalfSphere(shape, capsule, net, -1);
  addBand(shape, "side", round, uniformBasis(net.degree, net.alongLine()), side, true, true);
  addHalfSphere(shape, capsule, net, 1);
  return shape;
}

}  // namespace palpa::modeling
